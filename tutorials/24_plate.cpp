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
// both components of $θ$, and does one point cure it as it cured the beam? (b) How many functions are left with CR for
// $w$, and P1 and one more function per triangle for each component of $θ$?
//
// ## Reissner and Mindlin's plate in the class
//
// The plate is the beam of [chapter 22](22_beam.cpp) in two dimensions: a deflection $w$, a rotation $θ ∈ R^2$,
//
// $$ a_1 = ∫ (1 - ν) e(θ) : e(φ) + ν \operatorname{div} θ \operatorname{div} φ,   a_0 = ∫ (∇w - θ)·(∇v - φ), $$
//
// $L(v) = -q ∫ v$ and $K = \{ w ≥ -1 \text{ everywhere, clamped rim} \}$. Here $e$ is the symmetric gradient and
// $ν = 0.3$ Poisson's ratio. As $t → 0$, $θ = ∇w$ and $a_1$ becomes $∫ (Δw)^2$: Kirchhoff's plate. Contact is under
// the whole plate: one bound per unknown of $w$, not on a line.
//
// P1 and P1 with exact shear ask for a constant $θ$ on each triangle, so everywhere, and the rim makes it 0. Two cures
// change the shear strain that the energy sees, and both add to the rotation:
//
// - *Arnold–Falk* (1989): the mean of $∇w - θ$ over a triangle. $w$ is CR, whose gradients are constant. $θ$ is P1 and
// a *bubble* per triangle, $27 λ_0 λ_1 λ_2$, 0 on all edges. The bubble's mean is free: for every $w$ there is a $θ$
// without shear;
// - *Durán–Liberman* (1992), a reduced shear: the means of the tangential part $(∇w - θ)·τ$ on the edges. They
// determine a field $a + b (-y, x)$ per triangle, and this is what is squared. $w$ is P1. $θ$ is P1 and one function
// per edge along τ, which makes the mean on its edge 0.
//
// In both $a_0$ is not the plate's but an $a_{0h}$. Theorem 4 as stated compares spaces for one $a_0$: it covers the
// cures only if an $a_{0h}$ other than $a_0$ is allowed in it. Both papers prove a bound $C h$ for the linear plate,
// $C$ the same for all $t$. Contact on an open set leaves $w''$ bounded, so $h^2$ for $w$ is the most to hope for.
//
// The truth is a closed form for every $t$ (`exact/plate_truth.cpp`): contact on the disc $r ≤ c$.

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
// (a) $9n^2$ unknowns for $12n^2$ conditions: one point leaves nothing free, and cures the beam but not the plate. (b)
// $27n^2$ unknowns less $12n^2$ conditions: $15n^2 - 9n + 2$ = 3698 functions. Durán–Liberman leaves three per vertex
// off the rim. At $t = 1/10000$ P1 keeps nothing. The two cures are within $h^2 \max |w''| / 8$ of the truth at all
// $t ≤ 0.1$ and fall like $h^2$ in the limit. Durán–Liberman's error is the smaller one where $t ≪ h$, and rises where
// $t$ is near $h/2$ and the edge of the contact lies between two rings: at $t = 0.03$ it falls like $h^{0.63}$ only,
// over the three meshes ($h^{0.86}$ between the finer two), while the bound holds. At $t = 0.3$ nothing is locked.
//
// **What it costs.** One solution with 16 rings takes P1 0.01 to 0.02 s (error 1: any price is too high),
// Durán–Liberman 0.03 s (error 0.0004) and Arnold–Falk 0.05 s (error 0.005, half as many unknowns again).
//
// ## Exercises
//
// 1. Leave the bubbles out of Arnold–Falk: how many functions are left at least, and does it lock at $t = 0$?
// 2. Double the load and the gap. Do deflection and contact force double? And the disc of contact?
// 3. On paper: at $t = 0$ Durán and Liberman's edge functions are known once $w$ and $θ$ are known at the vertices. Why
//    is that so, and why are three functions per inner vertex left?

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
