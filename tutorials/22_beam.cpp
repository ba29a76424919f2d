// # A beam over an obstacle
//
// Run: 22_beam                             ε = 1e-4, 32 cells
// Run: 22_beam --epsilon 1e-2 --cells 64   a thick beam: both integrations are good
// Run: 22_beam --exercise 1
// Run: 22_beam --exercise 2
//
// Needs: [00](00_string_on_an_obstacle.cpp) for contact, [03](03_by_hand.cpp) for $B$ and $M$,
// [06](06_p1_unstructured.cpp) for locking, [07](07_kernel.cpp) for kernels. **Here ε is the parameter of the class
// (1) itself**, the square of the beam's thickness but for a factor, as $ε^2$ was in (23).
//
// **The picture.** A clamped beam is pressed on a flat obstacle at height $-1$. *With full integration it bends too
// little and touches over too short a length, and nothing looks wrong.*
//
// **Predict.** (a) The unknowns are the deflection $w$ and the rotation $θ$ of the sections, both P1. In the limit
// $w' = θ$ is asked. How many independent pairs $(w, θ)$ fulfil it at every point? (b) And if it is asked at the
// midpoints of the $n$ cells only?
//
// ## Timoshenko's beam in the class
//
// A beam stores bending energy by $θ'$ and shear energy by $w' - θ$, the angle between section and axis:
//
// $$ a_1 = ∫ θ' φ',   a_0 = ∫ (w' - θ)(v' - φ),   L(v) = -q ∫ v,   K = \{ w ≥ -1, \text{ clamped at both ends} \}. $$
//
// The thinner the beam, the stiffer its shear against its bending: $a_1 + ε^{-1} a_0$ with $ε → 0$ asks for $w' = θ$,
// which is Bernoulli's beam. On a cell $w'$ is constant and $θ$ affine. At two Gauss points (*full integration*,
// exact here) $θ$ must be constant on the cell, so on all cells, and 0 by the clamps: $G_h = \{0\}$. At the midpoint
// (*reduced integration*) there is one condition per cell for $2n - 2$ unknowns: $n - 2$ functions are left.
//
// How much too stiff is the first? $θ$ is affine on a cell of length $h$, with mean $\bar θ$, and
// $∫ (θ - \bar θ)^2 = h^3 θ'^2 / 12$. So the shear energies differ by a bending energy:
//
// $$ ∫ (w' - θ)^2 = ∫ (w' - \bar θ)^2 + \frac{h^2}{12} ∫ θ'^2, $$
//
// and full integration is reduced integration with a bending stiffness $1 + h^2/(12 ε)$ times too large, contact
// included: 1.8 times at $h = 1/32$, ε = 1e-4.
//
// Theorem 4 does not cover the cure as it is written: the theorem compares spaces for one $a_0$, and reduced
// integration is another $a_0$. For a constant load it can be read as another $V_h$. Add to $w$ on each cell the
// parabola $b$ with $b' = θ - \bar θ$. It is 0 at both ends of the cell. Then $(w + b)' - θ = w' - \bar θ$: the reduced
// form of $(w, θ)$ is the exact form of $(w + b, θ)$. A constant load does not see $b$ (exercise 3). Without shear
// $w + b$ is made of parabolas with a continuous slope: these are the $n - 2$ functions. The truth is a closed form
// (`exact/beam_truth.cpp`): contact on $[c, 1 - c]$, at ε = 0 with $c = (72 / q)^{1/4}$.

#include "antilock/analysis/kernel.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/solve/active_set.hpp"
#include "common/beam.hpp"

using namespace antilock;

void bend(const tutorial::Options& options, tutorial::Report& report) {
  // ### Mesh
  // Cells of equal size; the same beam with two choices of $B$.
  const Beam full_beam{.cells = options.cells, .epsilon = options.epsilon, .shear = ShearIntegration::full};
  const Beam reduced_beam{.cells = options.cells, .epsilon = options.epsilon, .shear = ShearIntegration::reduced};
  const VariationalInequality full = assemble(full_beam), reduced = assemble(reduced_beam);
  // ### Forms
  // The diagnosis before any solve: what $B$ leaves free.
  const int full_kernel = kernel_dimension(full), reduced_kernel = kernel_dimension(reduced);

  // ### Solve
  // And the reduced one again with the stiffness of the identity above.
  const Solution locked = active_set(full), good = active_set(reduced);
  VariationalInequality stiffer = reduced;
  const double h = 1.0 / options.cells, factor = 1 + h * h / (12 * options.epsilon);
  if (options.epsilon > 0) stiffer.a1 *= factor;
  const double difference = (active_set(stiffer).u - locked.u).cwiseAbs().maxCoeff();
  const Table errors = tutorial::beam_errors({16, 32, 64});

  // ### Output
  const BeamTruth truth(reduced_beam);
  const double full_error = tutorial::nodal_error(full_beam, locked),
               reduced_error = tutorial::nodal_error(reduced_beam, good);
  Table table({"", "kernel", "error of w", "contact force", "energy"});
  table.add({"full integration", full_kernel, full_error, locked.lambda.sum(), energy(full, locked)});
  table.add({"reduced integration", reduced_kernel, reduced_error, good.lambda.sum(), energy(reduced, good)});
  table.add({"truth", "", "", truth.contact_force(), truth.energy()});
  table.print(fmt::format("contact on [c, 1 - c], c = {:.5f}", truth.contact_start()), 6);
  tutorial::draw_beam(reduced_beam, locked, good).write(options.out / "beam.csv");
  errors.write(options.out / "errors.csv");

  report.claim(full_kernel == 0 && reduced_kernel == options.cells - 2,
               "full integration leaves no function free, reduced {} = n - 2", reduced_kernel);
  if (options.epsilon > 0)
    report.claim(difference < 1e-8,
                 "full is reduced with a bending stiffness {:.4g} times too large (difference {:.1e})", factor,
                 difference);
  else
    report.claim(locked.u.cwiseAbs().maxCoeff() < 1e-8, "at epsilon = 0 full integration does not move: |w| <= {:.0e}",
                 locked.u.cwiseAbs().maxCoeff());
  if (truth.contact_start() < 4 * h)
    return report.not_judged("the errors of w: that takes a mesh with four cells in the free part (0, c)");
  if (12 * options.epsilon <= 2 * h * h)
    report.claim(full_error > 3 * reduced_error, "full integration locks: error of w {:.1e}, reduced {:.1e}",
                 full_error, reduced_error);
  else
    report.not_judged("whether full integration locks: its stiffness is less than 1.5 times too large here");
  report.claim(reduced_error < 10 * h * h + 2e-3, "reduced integration does not: error of w {:.1e} at h = {:.3g}",
               reduced_error, h);
}

// ## What came out
//
// (a) None but 0, and at ε = 0 the beam does not move. (b) $n - 2$ = 30. At ε = 1e-4 full integration is
// 1.81 times too stiff: its error of $w$ is many times that of reduced integration, which falls like $h^2$ at every
// ε. It is cured by $h^2 ≪ ε$ alone.
//
// ## Exercises
//
// 1. Double the load. Do deflection, force and contact double? And if the gap doubles with it?
// 2. How many cells does full integration need at ε = 1e-4 to be 1 % too stiff?
// 3. On paper: reduced integration changes $a_0$. When is it a choice of $V_h$ all the same? Show $∫ b = -h^3 θ'/12$
//    on a cell. Why does a constant load not see $b$? (Sum up, use the clamps.)

#include "answers/22_beam.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "22_beam", "Timoshenko's beam over an obstacle: full integration locks",
                       {.epsilon = 1e-4,
                        .epsilon_is = "the class parameter of (1), bending by shear stiffness; 0 is the Bernoulli beam",
                        .exercises = exercises},
                       bend);
}
