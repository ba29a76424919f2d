// A thin structure in the same class: Timoshenko's beam over an obstacle, full against reduced
// integration.
//
// Run: 22_beam                             epsilon = 1e-4, 32 cells
// Run: 22_beam --epsilon 1e-2 --cells 64   a thick beam: both integrations are good
//
// Here epsilon is the parameter of the class, (1): the square of the beam's thickness but for a
// factor, as epsilon^2 was in (23). The two integrations below are two forms a0, not two choices of
// V_h: Theorem 4 compares spaces for one a0, and does not cover reduced integration.
//
// What the picture shows. A clamped beam is pressed on a flat obstacle at -1. The exact beam lies
// on it over [c, 1 - c], and presses most near the two ends of contact (at epsilon = 0: over the
// middle third, with two concentrated forces at its ends). Full integration bends too little: the
// deflection stays above the truth and contact is short; at epsilon = 0 it does not move at all.
// Nothing looks wrong.
//
// Why. The unknowns are the deflection w and the rotation theta, both P1. With
//
//     u = (w, theta) in K,  a1(u, v-u) + epsilon^-1 a0(u, v-u) >= L(v-u)  for all v in K,       (6)
//     a1 = int theta' phi',  a0 = int (w' - theta)(v' - phi),  K = { w >= -1, clamped at both ends },
//
// epsilon^-1 a0 demands w' = theta as epsilon -> 0. On a cell w' is constant and theta affine.
// Asked at two Gauss points, the demand is that theta be constant on each cell, and so zero. Asked
// at the midpoint, it is one condition per cell, and n - 2 free functions are left. In one line,
// because theta is affine:
//
//     full shear energy = reduced shear energy + h^2/(12 epsilon) int theta'^2
//
// so that full integration is the reduced one with a bending stiffness 1 + h^2/(12 epsilon) times
// too large, contact included. At h = 1/32, epsilon = 1e-4: 1.8 times.

#include <cmath>

#include "antilock/analysis/kernel.hpp"
#include "antilock/exact/beam_truth.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/study/sweep.hpp"
#include "antilock/study/table.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

double nodal_error(const Beam& beam, const Solution& solution);
Table drawn(const Beam& beam, const Solution& full, const Solution& reduced);

// The error against epsilon, both integrations, on three meshes: one sweep per mesh and
// integration.
Table error_study() {
  Table table({"integration", "cells", "epsilon", "error"});
  for (const auto& [shear, name] :
       {std::pair{ShearIntegration::full, "full integration"}, {ShearIntegration::reduced, "reduced integration"}})
    for (const int cells : {16, 32, 64}) {
      Beam beam{.cells = cells, .shear = shear};
      Sweep sweep(assemble(beam));
      for (int k = 4; k <= 16; ++k) {
        beam.epsilon = std::pow(10.0, -0.5 * k);
        sweep.set_compliance(beam.epsilon);
        table.add({name, cells, beam.epsilon, nodal_error(beam, sweep.solve())});
      }
    }
  return table;
}

void bend(const tutorial::Options& options, tutorial::Report& report) {
  // 1. The same beam with two choices of B.
  const Beam full_beam{.cells = options.cells, .epsilon = options.epsilon, .shear = ShearIntegration::full};
  const Beam reduced_beam{.cells = options.cells, .epsilon = options.epsilon, .shear = ShearIntegration::reduced};
  const VariationalInequality full = assemble(full_beam), reduced = assemble(reduced_beam);

  // 2. The diagnosis before any solve: what B leaves free.
  const int full_kernel = kernel_dimension(full), reduced_kernel = kernel_dimension(reduced);

  // 3. Solve; and the reduced one again with the stiffness of the identity.
  report.stage("solve");
  const Solution locked = active_set(full), good = active_set(reduced);
  VariationalInequality stiffer = reduced;
  const double h = 1.0 / options.cells, factor = 1 + h * h / (12 * options.epsilon);
  if (options.epsilon > 0) stiffer.a1 *= factor;
  const double difference = (active_set(stiffer).u - locked.u).cwiseAbs().maxCoeff();
  report.stage("error against epsilon, three meshes");
  const Table errors = error_study();
  report.finish();

  const BeamTruth truth(reduced_beam);
  const double full_error = nodal_error(full_beam, locked), reduced_error = nodal_error(reduced_beam, good);
  Table table({"", "kernel", "error of w", "contact force", "energy"});
  table.add({"full integration", full_kernel, full_error, locked.lambda.sum(), energy(full, locked)});
  table.add({"reduced integration", reduced_kernel, reduced_error, good.lambda.sum(), energy(reduced, good)});
  table.add({"truth", "", "", truth.contact_force(), truth.energy()});
  table.print(fmt::format("contact on [c, 1 - c], c = {:.5f}", truth.contact_start()), 6);
  drawn(reduced_beam, locked, good).write(options.out / "beam.csv");
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

// Three things to try:
// - thinner: --epsilon 1e-8, or 0, the Bernoulli beam. Full integration does not move; the error of
//   reduced stays.
// - refine: --cells 128. The factor 1 + h^2/(12 epsilon) falls to 1.05: full integration wants h^2
//   << epsilon.
// - the point forces: plot force_reduced of beam.csv; the ends of contact carry 2/5 of the force at
//   epsilon = 0.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.epsilon = 1e-4;
  options.epsilon_is = "the class parameter of (1), bending by shear stiffness; 0 is the Bernoulli beam";
  return tutorial::run(argc, argv, "22_beam", "Timoshenko's beam over an obstacle: full integration locks", options,
                       bend);
}

double nodal_error(const Beam& beam, const Solution& solution) {
  const BeamTruth truth(beam);
  double largest = 0;
  for (int i = 0; i <= beam.cells; ++i)
    largest = std::max(largest, std::abs(solution.u(2 * i) - truth.deflection(static_cast<double>(i) / beam.cells)));
  return largest;
}

// For the picture: deflections and nodal forces, one row per node.
Table drawn(const Beam& beam, const Solution& full, const Solution& reduced) {
  const BeamTruth truth(beam);
  Table table({"x", "w_full", "w_reduced", "w_exact", "force_full", "force_reduced"});
  for (int i = 0; i <= beam.cells; ++i) {
    const double x = i * (1.0 / beam.cells);
    const bool inside = i > 0 && i < beam.cells;
    table.add({x, full.u(2 * i), reduced.u(2 * i), truth.deflection(x), inside ? full.lambda(i - 1) : 0.0,
               inside ? reduced.lambda(i - 1) : 0.0});
  }
  return table;
}
