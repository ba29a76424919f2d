// # A beam over an obstacle
//
// Run: 25_beam                             ε = 1e-4, 32 cells; errors over all ε <= 1e-2 on four meshes
// Run: 25_beam --epsilon 1e-2 --cells 64   a thick beam: both integrations are good
// Run: 25_beam --exercise 1
// Run: 25_beam --exercise 2
//
// Needs: [00](../00_string_on_an_obstacle/00_string_on_an_obstacle.cpp) for contact,
// [03](../03_by_hand/03_by_hand.cpp) for $B$ and $M$,
// [06](../06_p1_unstructured/06_p1_unstructured.cpp) for locking,
// [07](../07_kernel/07_kernel.cpp) for kernels, [13](../13_uniform/13_uniform.cpp) for the
// supremum over ε. **Here ε is the parameter of the class (1) itself**, the square of the
// beam's thickness but for a factor, as $ε^2$ was in (23).
//
// **The picture.** A clamped beam is pressed on a flat obstacle at height $-1$. *With full
// integration it bends too little and touches over too short a length, and nothing looks
// wrong.*
//
// **Predict.** (a) The unknowns are the deflection $w$ and the rotation $θ$ of the
// sections, both P1. In the limit $w' = θ$ is asked. How many independent pairs $(w, θ)$
// fulfil it at every point? (b) And if it is asked at the midpoints of the $n$ cells only?
//
// ## Timoshenko's beam in the class
//
// A beam stores bending energy by $θ'$ and shear energy by $w' - θ$, the angle between
// section and axis:
//
// $$ a_1 = ∫ θ' φ',   a_0 = ∫ (w' - θ)(v' - φ),   L(v) = -q ∫ v,   K = \{ w ≥ -1, \text{ clamped at both ends} \}. $$
//
// The thinner the beam, the stiffer its shear against its bending. In the limit
// $a_1 + ε^{-1} a_0$ with $ε → 0$ asks for $w' = θ$, which is Bernoulli's beam.
//
// On a cell $w'$ is constant and $θ$ is affine. *Full integration* takes the shear energy
// at two Gauss points, which is exact here. It is 0 only if $θ$ is constant on the cell.
// $θ$ is continuous, so it is constant on all cells, and the clamps make it 0:
// $G_h = \{0\}$. *Reduced integration* takes the midpoint of the cell. That is one
// condition per cell for $2n - 2$ unknowns, and $n - 2$ functions are left.
//
// How much too stiff is full integration? Let $\bar θ$ be the mean of $θ$ on a cell of
// length $h$. Because $θ$ is affine, $∫ (θ - \bar θ)^2 = h^3 θ'^2 / 12$. So the two shear
// energies differ by a bending energy:
//
// $$ ∫ (w' - θ)^2 = ∫ (w' - \bar θ)^2 + \frac{h^2}{12} ∫ θ'^2. $$
//
// Full integration is therefore reduced integration with a bending stiffness that is
// $1 + h^2/(12 ε)$ times too large, contact included: 1.8 times at $h = 1/32$, ε = 1e-4.
// This factor grows without bound as ε falls. It comes near 1 only where $h^2 ≪ ε$: full
// integration needs cells that are small against the thickness. Choose ε and the cells:
//
// :live: beam
//
// ## Why reduced integration converges uniformly
//
// Reduced integration is not another $V_h$, as in the chapters before. It is another form,
//
// $$ a_{0h} = ∫ (w' - P θ)(v' - P φ), $$
//
// where $P$ takes the mean on each cell. [Chapter 28](../28_mixed/28_mixed.cpp) proves
// Theorem 4 for such forms under four conditions, (i) to (iv). The beam fulfils them, with
// the obstacle:
//
// - (i) *$a_1 + a_{0h}$ is coercive, with one constant for all $h$.* $a_1$ bounds $θ$,
//   because $θ$ is clamped. And $|w'| ≤ |w' - P θ| + |P θ|$ bounds $w$: a mean is not
//   larger than its function.
// - (ii) *Each limit $w$, with $θ = w'$, is approached by pairs without shear, above the
//   obstacle.* Let $θ_h$ be P1 with $∫ θ_h = 0$. The values $w_h(x_i) = ∫_0^{x_i} θ_h$ at
//   the nodes make a P1 function with $w_h' = P θ_h$, clamped at both ends. Start from the
//   interpolant of $θ$. It tends to $θ$ in $H^1$, so its integral misses $w$ by some
//   $δ_h → 0$ at most. Add multiples of two fixed smooth slopes, of size $C δ_h$. First
//   lift $w_h$ by $C δ_h$ where $w < -½$. Then restore $∫ θ_h = 0$, which the interpolant
//   missed by $δ_h$ and the lift by $O(h^2 δ_h)$. This moves $w_h$ by at most $C' δ_h$.
//   With $C ≥ C' + 1$ still $w_h ≥ -1$. (Where shear is allowed, interpolation is enough:
//   $K_h$ approaches $K$.)
// - (iii) *Bounded pairs whose shear $w_h' - P θ_h$ tends to 0 have limits without shear.*
//   $θ_h$ tends to $θ$ strongly in $L^2$, and so does $P θ_h$, because
//   $|θ_h - P θ_h| ≤ h |θ_h'|$. So $w_h' - P θ_h$ tends weakly to $w' - θ$, which is 0.
// - (iv) *$a_{0h}$ passes to the limit*: it is the product of a weak and a strong limit, or
//   a square, by the same line.
//
// So the error of the reduced beam tends to 0 uniformly in ε (*proved*). Its order is
// measured below. For a constant load there is a second way to see it. Add to $w$ on each
// cell the parabola $b$ with $b' = θ - \bar θ$, which is 0 at both ends of the cell. Then
// $(w + b)' - θ = w' - \bar θ$: the reduced form of $(w, θ)$ is the exact form of
// $(w + b, θ)$. So this *is* another $V_h$, as long as the load does not see $b$ (exercise
// 3).
//
// The truth is a closed form (`lib/antilock/exact/exact_beam.hpp`): contact on
// $[c, 1 - c]$, at ε = 0 with $c = (72 / q)^{1/4}$.

#include <cmath>

#include "antilock/analysis/kernel.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/sweep.hpp"
#include "course/course.hpp"
#include "support.hpp"

using namespace antilock;

// The error of $w$ in $L^2$, between the nodes too. (At the nodes alone the largest error
// has narrow peaks, where the end of contact passes a node: a list of ε misses them.)
double error_of_w(const Beam& beam, const Eigen::VectorXd& u) {
  const ExactBeam exact(beam);
  const auto [points, weights] = gauss_rule(4);
  const double h = 1.0 / beam.cells;
  double square = 0;
  for (int i = 0; i < beam.cells; ++i)
    for (Eigen::Index q = 0; q < points.size(); ++q) {
      const double w = (1 - points(q)) * u(2 * i) + points(q) * u(2 * i + 2);
      square += h * weights(q) * std::pow(w - exact.deflection((i + points(q)) * h), 2);
    }
  return std::sqrt(square);
}

// Eight ε per decade from 1e-2 to 1e-8, and 0. Above 1e-2 the beam falls on the obstacle
// within $c < 0.18$, at ε = 1 within 0.019: that takes other meshes.
Table errors_over_epsilon(ShearIntegration shear, const std::string& name) {
  Table table({"integration", "cells", "h", "epsilon", "error"});
  for (const int cells : {16, 32, 64, 128}) {
    Beam beam{.cells = cells, .shear = shear};
    Sweep sweep(assemble(beam));
    for (int k = 0; k <= 49; ++k) {
      beam.epsilon = k == 49 ? 0 : std::pow(10.0, -2 - k / 8.0);
      sweep.set_compliance(beam.epsilon);
      table.add(
          {name, cells, 1.0 / cells, beam.epsilon, error_of_w(beam, sweep.solve().u)});
    }
  }
  return table;
}

void judge_uniform(const Table& full, const Table& reduced, tutorial::Report& report);

void bend(const tutorial::Options& options, tutorial::Report& report) {
  // ### Mesh
  // Cells of equal size; the same beam with two choices of $B$.
  const Beam full_beam{
      .cells = options.cells, .epsilon = options.epsilon, .shear = ShearIntegration::full};
  const Beam reduced_beam{.cells = options.cells,
                          .epsilon = options.epsilon,
                          .shear = ShearIntegration::reduced};
  const VariationalInequality full = assemble(full_beam), reduced = assemble(reduced_beam);
  // ### Forms
  // The diagnosis before any solve: what $B$ leaves free.
  const int full_kernel = kernel_dimension(full),
            reduced_kernel = kernel_dimension(reduced);

  // ### Solve
  // And the reduced one again with the stiffness of the identity above.
  const Solution locked = active_set(full), good = active_set(reduced);
  VariationalInequality stiffer = reduced;
  const double h = 1.0 / options.cells, factor = 1 + h * h / (12 * options.epsilon);
  if (options.epsilon > 0) stiffer.a1 *= factor;
  const double difference = (active_set(stiffer).u - locked.u).cwiseAbs().maxCoeff();

  // ### Output
  const ExactBeam exact(reduced_beam);
  Table table({"", "kernel", "error of w", "contact force", "energy"});
  table.add({"full integration", full_kernel, error_of_w(full_beam, locked.u),
             locked.lambda.sum(), energy(full, locked)});
  table.add({"reduced integration", reduced_kernel, error_of_w(reduced_beam, good.u),
             good.lambda.sum(), energy(reduced, good)});
  table.add({"truth", "", "", exact.contact_force(), exact.energy()});
  table.print(fmt::format("contact on [c, 1 - c], c = {:.5f}", exact.contact_start()), 6);
  tutorial::draw_beam(reduced_beam, locked, good).write(options.out / "beam.csv");

  report.claim(full_kernel == 0 && reduced_kernel == options.cells - 2,
               "(proved) full integration leaves no function free, reduced {} = n - 2",
               reduced_kernel);
  // 1e-12: round-off is 3e-14 at most, up to $n$ = 1024
  if (options.epsilon > 0)
    report.claim(difference < 1e-12,
                 "(proved) full is reduced with a bending stiffness {:.4g} times too large "
                 "(difference {:.1e})",
                 factor, difference);
  else
    report.claim(locked.u.cwiseAbs().maxCoeff() < 1e-8,
                 "(proved) at epsilon = 0 full integration does not move: |w| <= {:.0e}",
                 locked.u.cwiseAbs().maxCoeff());
  const Table every_full = errors_over_epsilon(ShearIntegration::full, "full integration"),
              every_reduced =
                  errors_over_epsilon(ShearIntegration::reduced, "reduced integration");
  judge_uniform(every_full, every_reduced, report);
  Table both = every_full;
  both.add(every_reduced);
  both.filter_number("cells", [](double n) { return n <= 64; })
      .write(options.out / "errors.csv");
}

// The supremum over ε first, then the order. At ε = 0 the curvature on $(0, c)$ is
// $-\frac{q}{2} (x - c)(x - c/3)$, so that $‖w''‖ = q c^{5/2} / 135^{1/2}$. Of a function
// with constant curvature the P1 interpolant misses $h^2 ‖w''‖ / 120^{1/2}$ in $L^2$: the
// unit of the third claim.
void judge_uniform(const Table& full, const Table& reduced, tutorial::Report& report) {
  const tutorial::Supremum worst = tutorial::supremum(reduced, "error", "epsilon");
  worst.rows.print(
      "reduced integration: the largest error of w over epsilon, and its order");
  report.claim(
      worst.denser < 1.02,
      "every second epsilon would do: the suprema grow by {:.2f} % with the others",
      100 * (worst.denser - 1));
  report.claim_orders(worst.rows, "worst", 1.9, 2.1,
                      "(convergence proved) reduced integration, sup over epsilon");
  const double q = Beam{}.load, c = std::pow(72 / q, 0.25),
               curvature = q * std::pow(c, 2.5) / std::sqrt(135.0);
  double most = 0;
  for (const Table& row : worst.rows.rows())
    most = std::max(most, row.number("worst") / (std::pow(row.number("h"), 2) * curvature /
                                                 std::sqrt(120.0)));
  report.claim(
      most > 1 && most < 2,
      "(observed) it is at most {:.2f} times what interpolation of Bernoulli's beam misses",
      most);
  // What is lost at ε = 0 is all of $w$, on every mesh.
  const double whole =
      error_of_w({.cells = 1024, .epsilon = 0}, Eigen::VectorXd::Zero(2050));
  const tutorial::Supremum locked = tutorial::supremum(full, "error", "epsilon");
  report.claim(
      std::abs(locked.rows.min("worst") / whole - 1) < 1e-3 &&
          std::abs(locked.rows.max("worst") / whole - 1) < 1e-3,
      "(proved) full integration locks: its sup over epsilon is |w| = {:.4f} on every mesh",
      whole);
}

// ## What came out
//
// :output: reduced integration: the
//
// (a) None but 0, and at ε = 0 the beam does not move. (b) $n - 2$ = 30. At ε = 1e-4 full
// integration is 1.81 times too stiff, and its error of $w$ is 15 times that of reduced
// integration. Over all ε the error of reduced integration has the order 2. At one fixed ε
// it does not fall so evenly, because the end of contact lies now near a node, now between
// two: hence the supremum first.
// :number: 1.81 = line "bending stiffness {} times too large"
//
// :figure: beam_error
//
// ## Exercises
//
// 1. Double the load. Do deflection, force and contact double? And if the gap doubles with
//    it?
// 2. How many cells does full integration need at ε = 1e-4 to be 1 % too stiff?
// 3. On paper: for which loads is reduced integration the exact form on another space?
//    Compute $∫ b$ on a cell.
//
// ## Further reading
//
// - [Braess 2007](../guides/bibliography.md#braess-2007): locking of beams and plates.
// - [Babuška and Suri 1992](../guides/bibliography.md#babuska-1992): the definitions of
//   locking and robustness.

#include "answers.hpp"

int main(int argc, char** argv) {
  return tutorial::run(argc, argv, "25_beam",
                       "Timoshenko's beam over an obstacle: full integration locks",
                       {.epsilon = 1e-4,
                        .epsilon_is = "the class parameter of (1), bending by shear "
                                      "stiffness; 0 is the Bernoulli beam",
                        .exercises = exercises},
                       bend);
}
