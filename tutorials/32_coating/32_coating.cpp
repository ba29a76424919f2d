// # A block with a stiff coating
//
// Run: 32_coating                           thickness t = 1e-6, 32 cells, six discretisations; t from 1 to 0
// Run: 32_coating --thickness 0 --cells 16  the limit: a membrane
// Run: 32_coating --exercise 1
// Run: 32_coating --exercise 2
// Run: 32_coating --exercise 3
//
// Needs: [07](../07_kernel/07_kernel.cpp) for kernels, [10](../10_limits/10_limits.cpp) for
// the stretched layer and its limit, [13](../13_uniform/13_uniform.cpp) for the supremum,
// [26](../26_elasticity/26_elasticity.cpp) for elasticity and the jumps of Crouzeix–Raviart
// (CR).
//
// **The picture.** A block is pressed on a round punch. Its lower side carries a coating, a
// million times thinner and stiffer (drawn stretched to the depth 1). *P1 on arbitrary
// triangles holds the coating flat: it touches the punch at its top alone, and the contact
// force is 73 % too large. With CR the coating follows the block.*
//
// **Predict.** The displacement has two components, $u$ along the coating and $v$ across
// it. (a) P1 locks, CR does not. Which of the two has to be CR for the right force, or
// both? And for the right displacement? (b) The coating is stretched along $x$. In plane
// strain, with Lamé's pair $λ, μ$, does it resist with the modulus $2μ$, with $λ + 2μ$, or
// with something between?
//
// ## From a thin coating to the class
//
// The coating has the thickness $t$ and the moduli $λ/t$ and $μ/t$: half as thick means
// twice as stiff. (All lengths are relative to the side of the block. In (22) the same
// scaling is $μ/ε$.) Its energy is half of
//
// $$ \frac{1}{t} ∫_{-t}^{0} λ (u_x + v_y)^2 + 2μ u_x^2 + 2μ v_y^2 + μ (u_y + v_x)^2. $$
//
// Stretch it: with $Y = y/t$ a slope across is divided by $t$, the area is multiplied by
// it. The factor in front cancels:
//
// $$ ∫_{-1}^{0} λ (u_x + v_Y/t)^2 + 2μ u_x^2 + 2μ (v_Y/t)^2 + μ (u_Y/t + v_x)^2. $$
//
// For thin coatings both slopes across, $u_Y$ and $v_Y$, must be small, since they are
// divided by $t$. But the quotient $v_Y/t$ need not be small: it has a best value for each
// $u_x$, because a sheet that is stretched becomes thinner. Complete the square in this
// quotient. With $r = λ/(λ + 2μ)$, which is $ν/(1 - ν)$ for Poisson's ratio ν, the
// integrand becomes
//
// $$ (λ + 2μ) (v_Y/t + r u_x)^2 + E_m u_x^2 + μ (u_Y/t + v_x)^2,
// E_m = λ + 2μ - \frac{λ^2}{λ + 2μ} = \frac{4μ(λ + μ)}{λ + 2μ}. $$
//
// This is the class (1) with the parameter $t^2$. The middle term joins $a_1$. The two
// squares are the stiff form: times $t$, what is squared in them gives two rows of $B$ per
// point, with weights $λ + 2μ$ and $μ$ in $M$:
//
// $$ v_Y + r t u_x,   u_Y + t v_x. $$
//
// In the limit both rows lose their second term. Then the displacement does not depend on
// $Y$, and the coating is a
// *membrane* of modulus $E_m$ on the lower side of the block. Without the completed square
// $a_1$ would hold $2 μ u_x^2$, and this would be the modulus of the limit: too soft, since
// thin coatings do not tend to it (exercise 1).
//
// ## Which component locks
//
// Contact asks for $v ≥ -$gap on $Γ_C$. In the limit $v$ does not change across the layer,
// so what touches the punch is the lower side of the block. For $v$ this is the problem of
// chapter 06: with free sides P1 on arbitrary triangles has $1$ and $x$ and no other
// function of $x$ alone, so the coating can be moved and tilted, but not bent round the
// punch. The same holds for $u$. But $u$ is not asked to be anywhere on $Γ_C$. If it is
// locked, the coating and the lower side of the block are only stretched evenly. This costs
// some energy, and the block still comes to lie on the punch.
//
// ## Rows that depend on t
//
// In all chapters before, $B$ did not depend on the parameter. Here $B = B_0 + t B_1$. Take
// a motion $w$ that costs nothing in the limit, $B_0 w = 0$. Can it be corrected by a small
// motion $t z$ so that it costs nothing for $t > 0$, too? Multiply out:
//
// $$ B (w + t z) = t (B_1 w + B_0 z) + t^2 B_1 z. $$
//
// If some $z$ has $B_0 z = -B_1 w$, the first term is gone. The stiff energy is the square
// of the rest divided by $t^2$: it is of order $t^2$, and the motion is free. If there is
// no such $z$, the stiff energy keeps a part that does not depend on $t$: the motion is
// neither stiff nor free, however thin the coating is. For P1 in columns $w = (u(x), 0)$ is
// such a motion if $u$ has a kink at a vertical mesh line: the two triangles at an edge of
// this line have the same slope $v_Y$ along it, and two different $u_x$ (exercise 4). The
// iterated penalty of chapter 18 divides by $δ$ in place of $t^2$. With $δ$ far above $t^2$
// it sees only the share $t^2/δ$ of this part, and each correction brings in one more such
// share: it takes many. The remedy is $δ = t^2$. Down to $t = 10^{-6}$ the factor still
// keeps enough digits of $A_1$. CR in both components needs no remedy: its slope across
// takes any values, one per triangle, so there always is a $z$.

#include <CLI/CLI.hpp>

#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;

double gap(double x) { return (x - 0.5) * (x - 0.5); }  // of the round punch below

// ### Mesh
// A `CoatedBlock` is one of six discretisations: triangles in columns or arbitrary ones, an
// element per component. `locks` is about the force.
//
// ### Forms
// `models/coating.cpp` is those two formulas: `strain_form` for the block and for
// $E_m u_x^2$, `strain_form_factored` for $B$. The top is moved down by 0.1, the sides are
// free.
Coating coating(double thickness) {
  Coating scene;
  scene.thickness = thickness;
  scene.gap = gap;
  return scene;
}

// ### Solve
// Every $t$ has its own $B$, and so its own factor.
Solution pressed(const VectorSpace& space, double thickness) {
  ActiveSetOptions options;
  options.penalty = penalty(coating(thickness), space);
  return active_set(assemble(coating(thickness), space), options);
}

void judge(const Table& forces, const Table& diagnoses, int cells,
           tutorial::Report& report);

void press(const tutorial::Options& options, double thickness, tutorial::Report& report) {
  Table forces({"method", "locks", "h", "t", "force", "percent", "corrections"});
  Table diagnoses({"method", "locks", "found", "says"});
  for (const tutorial::CoatedBlock& method : tutorial::coated_blocks()) {
    report.stage(method.name);
    for (const int n : {options.cells / 4, options.cells / 2, options.cells}) {
      const Space x(method.mesh(n), method.in_x), y(x, method.in_y);
      for (const double t : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 0.0}) {
        const Solution solution = pressed({x, y}, t);
        const double force = solution.lambda.sum();
        forces.add({method.name, method.locks, 1.0 / n, t, force,
                    100 * std::abs(force / tutorial::reference(t) - 1),
                    solution.counters.corrections});
      }
      // ### Output
      // The pressed coating, on the mesh in the middle.
      if (n == options.cells / 2)
        tutorial::write_coating(options.out, method, {x, y}, pressed({x, y}, thickness),
                                coating(thickness));
    }
    // Asked before anything is solved: the limit problem on two meshes.
    const auto limit = [&](int n) {
      const Space x(method.mesh(n), method.in_x), y(x, method.in_y);
      return assemble(coating(0), {x, y});
    };
    const LockingDiagnosis found =
        diagnose_locking(limit(options.cells / 4), limit(options.cells / 2));
    diagnoses.add({method.name, method.locks, found.locks(), found.text()});
  }
  report.finish();
  tutorial::show_coating(options.out, forces, diagnoses, options.cells, gap);
  judge(forces, diagnoses, options.cells, report);
}

void judge(const Table& forces, const Table& diagnoses, int cells,
           tutorial::Report& report) {
  for (const Table& method : diagnoses.rows())
    report.claim(method.number("found") == method.number("locks"), "(observed) {}: {}",
                 method.entry("method").text(), method.entry("says").text());
  const Table thick = forces.filter_number("t", [](double t) { return t > 0; });
  double most = 0;
  for (const Table& run : thick.rows())
    if (run.entry("method").text() != "P2 / P2")
      most = std::max(most, run.number("corrections"));
  report.claim(most <= 10 && thick.max("corrections") <= 20,
               "(observed) {} corrections at most where B depends on t, {} with P2", most,
               thick.max("corrections"));
  if (cells < 32)
    return report.not_judged(
        "the contact force: fewer than 32 cells do not tell locked from inexact");
  for (const TableEntry& name : forces.unique("method")) {
    const Table own = forces.filter("method", name);
    const tutorial::Supremum worst = tutorial::supremum(own, "percent", "t");
    worst.rows.print(name.text() +
                     ": the force is off by so many per cent, the largest over t");
    if (own.max("locks") == 0) {
      // The end of contact is known to a cell: a multiple of $h$ that jumps from mesh to
      // mesh.
      const double per_h = worst.rows.last("worst") * cells;
      const double most_per_h = tutorial::percent_per_h(name.text());
      report.claim(per_h < most_per_h && per_h > most_per_h / 2 &&
                       worst.rows.last("worst") < worst.rows.first("worst") / 4,
                   "(observed) {}: the force is off by {:.0f} h per cent at worst, and by "
                   "{:.0f} % of that on a mesh four "
                   "times as coarse",
                   name.text(), per_h,
                   100 * worst.rows.last("worst") / worst.rows.first("worst"));
    } else {
      report.claim(worst.rows.last("worst") > 15 &&
                       worst.rows.last("worst") > 0.7 * worst.rows.first("worst"),
                   "(observed) {} locks: the force is off by {:.0f} % at worst, on a mesh "
                   "four times as coarse by {:.0f} %",
                   name.text(), worst.rows.last("worst"), worst.rows.first("worst"));
    }
  }
  const Table cr = forces.filter("method", "CR / CR").filter("h", 1.0 / cells);
  const double last = cr.filter("t", 1e-6).number("force"),
               limit = cr.filter("t", 0.0).number("force");
  report.claim(
      std::abs(last / limit - 1) < 1e-5,
      "(observed) CR tends to its own limit: force {:.7f} at t = 1e-6, {:.7f} at 0", last,
      limit);
}

// ## What came out
//
// :output: contact force, by t
//
// (a) For the force $v$ alone. With $u$ CR and $v$ P1 it is 73 % too large, like that of P1
// for both. P2 locks too: it has parabolas of $x$, and no more.
// :number: 73 = table "CR / P1: the force is off" worst h=0.03125
//
// **A right force, and yet locked.** With $u$ P1 and $v$ CR the force is right to 1 %. But
// on arbitrary triangles $u$ on the coating can only be $a + b x$ in the limit. It is wrong
// by half of its largest value, and finer meshes do not mend it: P1 / CR locks in $u$. The
// force does not show it, because the stretching of the coating has hardly any part in it.
// So whoever looks at one output may take a method that locks for one that does not. On
// arbitrary triangles only CR for both is free of locking.
//
// :figure: coating_force
//
// The diagnosis shows locking of the force before anything is solved, because it asks for
// the motions of the *bounded* unknowns. So it does not see P1 / CR lock in $u$, which has
// no bounds. The dimension of the kernel would not help: for CR / P1 it grows fast with the
// mesh, in the coating by motions of $u$.
//
// (b) Between: $E_m = 1.10$ lies between $2μ = 0.77$ and $λ + 2μ = 1.35$. In plane strain
// the sheet cannot become narrower out of the plane, but it can become thinner.
//
// The supremum over $t$ of an error shows in one number per mesh whether this output locks:
// it falls, or it stays. It speaks of one functional, here of the force, and of no other.
//
// :output: corrections, by t
//
// At most 8 corrections where $B$ depends on $t$, and some 10 with P2 and $t > 0$. With the
// penalty $δ ≈ 6 · 10^{-8}$ of the other chapters, P1 in columns and P1 / CR take some 40
// at $t = 10^{-6}$ (exercise 3). P1 in columns and P1 / CR have another force at $t = 0$
// than for $t → 0$: there are motions $w$ without a $z$. Of their energy $|B_1 w|^2$ a part
// of order $h^2$, which no $z$ removes, is present for $t > 0$ and absent at $t = 0$. So at
// fixed $h$ their $u_h^t$ does not tend to $u_h^0$: these two methods are not
// *asymptotic-preserving* (chapter 18).
//
// ## Exercises
//
// 1. Drop the completed square: rows $t u_x + v_Y$ (weight $λ$), $v_Y$ ($2μ$) and
//    $u_Y + t v_x$ ($μ$), $a_1$ with $2μ u_x^2$. How much further does the coating stretch
//    at $t = 0$ than at $t = 10^{-6}$?
// 2. CR / P1 at 1/h = 8 and 16: how does $\dim G_h$ grow, and how many independent motions
//    of the bounds are in it?
// 3. Press P1 in columns at $t = 10^{-4}$, $10^{-5}$, $10^{-6}$ with that penalty. How do
//    the corrections grow?
// 4. On paper: why is there no $z$ for P1 in columns, if $w = (u(x), 0)$ has a kink?
//
// ## Further reading
//
// - [Kikuchi and Oden 1988](../guides/bibliography.md#kikuchi-1988): contact in elasticity.
// - [Babuška and Suri 1992b](../guides/bibliography.md#babuska-1992b): locking in
//   elasticity.

#include "answers.hpp"

int main(int argc, char** argv) {
  double thickness = 1e-6;
  return tutorial::run(
      argc, argv, "32_coating", "A stiff coating in plane strain: six discretisations",
      {.takes_epsilon = false,
       .least_cells = 16,  // a quarter of them is the coarsest mesh
       .most_cells = 32,   // a factor at t = 1e-6 on a finer mesh has no digits to spare
       .add =
           [&](CLI::App& line) {
             line.add_option("--thickness", thickness,
                             "t of the pictures, relative to the block; 0: the limit")
                 ->check(CLI::Range(0.0, 1.0));
           },
       .exercises = exercises},
      [&](const tutorial::Options& options, tutorial::Report& report) {
        press(options, thickness, report);
      });
}
