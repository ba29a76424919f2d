// # A plate over an obstacle
//
// Run: 24_plate                            t = 1e-4, 16 rings, four elements
// Run: 24_plate --epsilon 1e-2 --cells 12  a thick plate, t = 0.1
// Run: 24_plate --exercise 1
// Run: 24_plate --exercise 2
//
// Needs: [07](07_kernel.cpp) for kernels, [08](08_crouzeix_raviart.cpp) for Crouzeix–Raviart (CR),
// [22](22_beam.cpp) for the beam and its shear, [23](23_elasticity.cpp) for the patch test. **Here ε is the parameter
// of the class (1) itself: $ε = t^2$**, the square of the thickness $t$ but for a factor.
//
// **The picture.** A round plate, clamped at its rim, is pressed on a flat obstacle at height $-1$. *With P1 a thin
// plate does not move, whether its shear is integrated exactly or at one point. With two other elements on the same
// triangles it lies on the obstacle where it should.*
//
// **Predict.** In the limit $∇w = θ$ is asked. Taken at one point of each triangle these are two conditions. The mesh
// has $n$ rings, $6n^2$ triangles, about $3n^2$ vertices and $9n^2$ edges. (a) How many unknowns has P1 for $w$ and
// both components of $θ$? Does one point cure it as it cured the beam? (b) How many unknowns are there with CR for $w$,
// and, for each component of $θ$, P1 and one more function per triangle? How many of them are left free?
//
// ## Reissner and Mindlin's plate in the class
//
// The plate is the beam of [chapter 22](22_beam.cpp) in two dimensions: a deflection $w$, a rotation $θ ∈ R^2$. With
// test functions $v$ and $φ$
//
// $$ a_1 = ∫ (1 - ν) e(θ) : e(φ) + ν \operatorname{div} θ \operatorname{div} φ,   a_0 = ∫ (∇w - θ)·(∇v - φ), $$
//
// $L(v) = -q ∫ v$ with $q = 256$, and $K = \{ w ≥ -1 \text{ everywhere, clamped rim} \}$: one bound per unknown of $w$,
// under the whole plate. Here $e(θ) = ½ (∇θ + ∇θ^T)$ and $ν = 0.3$ is Poisson's ratio. As $t → 0$, $θ = ∇w$. Then
// $a_1(θ, θ)$ becomes $∫ (Δw)^2$, since $∫ e(∇w) : e(∇w) = ∫ (Δw)^2$ by parts: *Kirchhoff's plate*.
//
// Let $w$ and $θ$ be P1 with exact shear. $∇w = θ$ makes $θ$ constant on each triangle. It is continuous, so constant
// everywhere, and the rim makes it 0. Two cures change the shear strain that the energy sees, and both add functions to
// the rotation:
//
// - *Arnold–Falk* (1989): the mean of $∇w - θ$ over each triangle is squared. $w$ is CR. $θ$ is P1 and a *bubble* per
// triangle, $27 λ_0 λ_1 λ_2$ with the three hat functions of its corners, 0 on all edges. The bubble sets the mean of
// $θ$ to any value: for every $w$, and every P1 part of $θ$, there is one $θ$ without shear;
// - *Durán–Liberman* (1992): the means of $(∇w - θ)·τ$ over the edges count, τ along the edge. On each triangle the one
// field $a + b (-y, x)$, $a ∈ R^2$, with these three means is squared. $w$ is P1. $θ$ is P1 and one function per edge,
// along τ, 0 on the two other edges. It sets the mean of its edge: for every P1 part again one $θ$ without shear.
//
// In both, $a_0$ is replaced by an $a_{0h}$. Theorem 4 compares spaces for one $a_0$, so it does not cover them as it
// stands; [chapter 25](25_mixed.cpp) states what an $a_{0h}$ must fulfil. For the linear plate both papers prove
// $‖θ - θ_h‖_1 + ‖w - w_h‖_{1,h} ≤ C h$, $C$ the same for all $t$. Interpolation of $w$ is wrong by up to
// $h^2 \max |w''| / 8$, and $w''$ is bounded where contact ends: $h^2$ in the largest error of $w$ is the most to expect.
//
// The truth is a closed form for every $t$ (`exact/plate_truth.cpp`): contact on the disc $r ≤ c$. *Patch test:* a
// plate that its rim bends to a constant curvature must have its exact rotation at the vertices.

#include <cmath>

#include "antilock/analysis/kernel.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/study/sweep.hpp"
#include "antilock/study/table.hpp"
#include "common/plate_study.hpp"
#include "common/tutorial.hpp"

using namespace antilock;
using tutorial::Discrete, tutorial::largest_error;
using Method = tutorial::PlateMethod;

const std::vector<Method> methods{
    {"P1 with exact shear", "p1", p1(), p1(), ShearRule::exact, true},
    {"P1 with one-point shear", "p1_one", p1(), p1(), ShearRule::mean, true},
    {"Duran-Liberman", "duran_liberman", p1(), p1(), ShearRule::edges, false},
    {"Arnold-Falk", "arnold_falk", crouzeix_raviart(), p1_bubble(), ShearRule::mean, false}};

const std::vector<double> thicknesses{0, 1e-20, 1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 3e-2, 1e-1, 3e-1, 1};

void press(const tutorial::Options& options, tutorial::Report& report) {
  Table checks({"element", "unknowns", "kernel", "expected", "patch", "seconds", "locks"});
  Table errors({"element", "rings", "h", "t", "error", "force", "corrections", "steps", "locks"});
  Table profile({"x", "element", "w"});
  for (const Method& method : methods) {
    report.stage(method.name);
    for (const int n : {options.cells / 2, 3 * options.cells / 4, options.cells}) {
      // ### Mesh
      // Rings of nearly equilateral triangles; the rim is clamped.
      const TriangleMesh mesh = disc_mesh(n);
      const Discrete on(method, mesh);
      // ### Forms
      // They do not hold $t$: one assembly serves every thickness.
      const VariationalInequality problem = assemble(Plate{}, on.space);
      // ### Solve
      // The contact set of one thickness starts the next; all small $t$ share one factor.
      Stopwatch watch;
      Sweep sweep(problem);
      for (const double t : thicknesses) {
        sweep.set_compliance(t * t);
        const Solution solution = sweep.solve();
        errors.add({method.name, n, 1.0 / n, t, largest_error(on.w, solution, PlateTruth(t)), solution.lambda.sum(),
                    solution.counters.corrections, solution.counters.contact, method.locks});
      }
      const double seconds = watch.seconds() / static_cast<double>(thicknesses.size());
      if (n < options.cells) continue;
      // ### Output
      sweep.set_compliance(options.epsilon);
      const Solution solution = sweep.solve();
      tutorial::draw(options, method, on.w, solution, profile);
      const double n2 = n * n, vertices = 3 * n2 - 3 * n + 1;  // off the rim
      const double left = method.locks ? 0 : method.shear == ShearRule::edges ? 3 * vertices : 15 * n2 - 9 * n + 2;
      const TriangleMesh small = disc_mesh(6);
      checks.add({method.name, problem.free_count(), kernel_dimension(problem), left,
                  std::max(tutorial::patch_error(method, small, 1), tutorial::patch_error(method, small, 1e-3)),
                  seconds, method.locks});
    }
  }
  report.finish();
  tutorial::print_plate(options.out, checks, errors, profile);
  for (const Table& row : checks.rows())
    report.claim(row.number("kernel") == row.number("expected"), "{}: dim G_h = {} of {}", row.entry("element").text(),
                 row.number("kernel"), row.number("unknowns"));
  tutorial::judge_plate(checks, errors, 1.0 / options.cells, report);
}

// ## What came out
//
// (a) $9n^2$ unknowns for $12n^2$ conditions. One point leaves nothing free, $\dim G_h = 0$: it cures the beam and not
// the plate. (b) $27n^2$ unknowns less $12n^2$ conditions: $15n^2 - 9n + 2$ = 3698 functions for $n = 16$.
// Durán–Liberman leaves three per vertex off the rim, 2163. At $t$ = 1e-4 P1 keeps nothing: its largest error is 1, the
// whole way to the obstacle. It fails the patch test, by 0.19 and 0.39; the cures pass it to 6e-15. Their errors are at
// most 0.35 (Durán–Liberman) and 0.61 (Arnold–Falk) of $h^2 \max |w''| / 8$ at all $t ≤ 0.1$. At $t = 0$ they fall like
// $h^{1.96}$ and $h^{1.92}$, to 0.0004 and 0.0053 with 16 rings, with 4419 and 6770 unknowns. Durán–Liberman's rises
// where $t$ is near $h/2$ and the edge of the contact lies between two rings: at $t = 0.03$ it is 0.003 and falls like
// $h^{0.63}$ only, over the three meshes ($h^{0.86}$ between the finer two); the bound still holds. At $t = 0.3$
// nothing is locked.
//
// ## Exercises
//
// 1. Leave the bubbles out of Arnold–Falk: how many functions are left at least, and does it lock at $t = 0$?
// 2. Double the load and the gap. Do deflection and contact force double? And the disc of contact?
// 3. On paper: at $t = 0$ Durán–Liberman's edge functions follow from $w$ and $θ$ at the vertices. Why?

#include "answers/24_plate.hpp"

int main(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "24_plate", "Reissner and Mindlin's plate over an obstacle: four elements",
      {.epsilon = 1e-8,
       .epsilon_is = "the class parameter of (1), the square of the thickness t; 0 is Kirchhoff's plate",
       .cells = 16,
       .least_cells = 8,
       .most_cells = 64,
       .exercises = exercises},
      press);
}
