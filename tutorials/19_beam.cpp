// A thin structure in the same class: Timoshenko's beam over an obstacle, full against reduced integration.
//
// Run: 19_beam                                 epsilon = 1e-4, 32 cells
// Run: 19_beam --epsilon 1e-2 --cells 64       a thick beam: both integrations are good
//
// What the picture shows. A clamped beam is pressed on a flat obstacle at -1. The exact one lies on it over the middle
// third and leaves it with two concentrated forces at the ends of contact. Full integration bends too little: the
// deflection stays above the truth and contact is short; at epsilon = 0 it does not move at all. Nothing looks wrong.
//
// Why. The unknowns are the deflection w and the rotation theta, both P1; epsilon^-1 int (w' - theta)^2 demands
// w' = theta as epsilon -> 0. On a cell w' is constant and theta affine: at two Gauss points the demand is theta
// constant, cell by cell, and so zero. At the midpoint it is one condition a cell, and n - 2 free functions are left.
// In one line, because theta is affine:
//
//     full shear energy = reduced shear energy + h^2/(12 epsilon) int theta'^2
//
// so that full integration is the reduced one with a bending stiffness 1 + h^2/(12 epsilon) times too large, contact
// included. At h = 1/32, epsilon = 1e-4: 1.8 times.

#include <fmt/format.h>

#include <cmath>

#include "antilock/analysis/kernel.hpp"
#include "antilock/core/atomic_file.hpp"
#include "antilock/exact/beam_truth.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/solve/active_set.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

// The inequality (6):  u = (w, theta) in K,  a1(u, v-u) + epsilon^-1 a0(u, v-u) >= L(v-u)  for all v in K, with
// a1 = int theta' phi', a0 = int (w' - theta)(v' - phi), K = { w >= -1, clamped at both ends }. The only difference
// between the two discretisations is B.
Beam make_beam(const tutorial::Options& options, ShearIntegration shear) {
  Beam beam;
  beam.epsilon = options.epsilon;
  beam.cells = options.cells;
  beam.shear = shear;
  return beam;
}

double nodal_error(const Beam& beam, const Solution& solution) {
  const BeamTruth truth(beam);
  double largest = 0;
  for (int i = 0; i <= beam.cells; ++i)
    largest = std::max(largest, std::abs(solution.u(2 * i) - truth.deflection(static_cast<double>(i) / beam.cells)));
  return largest;
}

// The error against epsilon, both integrations, on three meshes, as a table of text.
std::string error_study() {
  std::string table = "integration,cells,epsilon,error\n";
  for (const ShearIntegration shear : {ShearIntegration::full, ShearIntegration::reduced})
    for (const int cells : {16, 32, 64})
      for (int k = 4; k <= 16; ++k) {
        Beam beam;
        beam.cells = cells;
        beam.epsilon = std::pow(10.0, -0.5 * k);
        beam.shear = shear;
        table +=
            fmt::format("{},{},{},{}\n", shear == ShearIntegration::full ? "full integration" : "reduced integration",
                        cells, beam.epsilon, nodal_error(beam, active_set(assemble(beam))));
      }
  return table;
}

void bend(const tutorial::Options& options, tutorial::Report& report) {
  // 1. The same beam with two choices of B.
  report.stage("assemble, full and reduced integration");
  const Beam full_beam = make_beam(options, ShearIntegration::full);
  const Beam reduced_beam = make_beam(options, ShearIntegration::reduced);
  const VariationalInequality full = assemble(full_beam), reduced = assemble(reduced_beam);

  // 2. The diagnosis before any solve: what B leaves free.
  const int full_kernel = kernel_dimension(full), reduced_kernel = kernel_dimension(reduced);

  // 3. Solve; and the reduced one again with the stiffness of the identity.
  report.stage("solve");
  const Solution locked = active_set(full), good = active_set(reduced);
  VariationalInequality stiffer = reduced;
  const double h = 1.0 / options.cells;
  if (options.epsilon > 0) stiffer.a1 *= 1 + h * h / (12 * options.epsilon);
  const double difference = (active_set(stiffer).u - locked.u).cwiseAbs().maxCoeff();

  report.stage("error against epsilon, three meshes");
  const std::string study = error_study();
  report.finish();

  const BeamTruth truth(reduced_beam);
  const double full_error = nodal_error(full_beam, locked), reduced_error = nodal_error(reduced_beam, good);
  fmt::print("\n  {:<22} {:>10} {:>14} {:>14} {:>14}\n", "", "kernel", "error of w", "contact force", "energy");
  fmt::print("  {:<22} {:10} {:14.3e} {:14.2f} {:14.2f}\n", "full integration", full_kernel, full_error,
             locked.lambda.sum(), energy(full, locked));
  fmt::print("  {:<22} {:10} {:14.3e} {:14.2f} {:14.2f}\n", "reduced integration", reduced_kernel, reduced_error,
             good.lambda.sum(), energy(reduced, good));
  fmt::print("  {:<22} {:>10} {:>14} {:14.2f} {:14.2f}\n", "truth", "", "", truth.contact_force(), truth.energy());
  fmt::print("  contact on [c, 1 - c], c = {:.5f}\n\n", truth.contact_start());

  report.stage("write files");
  Eigen::MatrixXd table(options.cells + 1, 6);
  for (int i = 0; i <= options.cells; ++i) {
    const bool inside = i > 0 && i < options.cells;
    table.row(i) << i * h, locked.u(2 * i), good.u(2 * i), truth.deflection(i * h), inside ? locked.lambda(i - 1) : 0.0,
        inside ? good.lambda(i - 1) : 0.0;
  }
  write_csv(options.out / "beam.csv", {"x", "w_full", "w_reduced", "w_exact", "force_full", "force_reduced"}, table);
  write_file(options.out / "errors.csv", [&](std::ostream& out) { out << study; });
  report.finish();

  report.claim(full_kernel == 0 && reduced_kernel == options.cells - 2,
               fmt::format("full integration leaves no function free, reduced {} = n - 2", reduced_kernel));
  if (options.epsilon > 0)
    report.claim(difference < 1e-8,
                 fmt::format("full is reduced with a bending stiffness {:.4g} times too large (difference {:.1e})",
                             1 + h * h / (12 * options.epsilon), difference));
  // The claims are about meshes that see the free part of the beam, (0, c).
  if (truth.contact_start() < 4 * h) return;
  if (12 * options.epsilon <= 2 * h * h)
    report.claim(full_error > 3 * reduced_error,
                 fmt::format("full integration locks: error of w {:.1e}, reduced {:.1e}", full_error, reduced_error));
  report.claim(reduced_error < 10 * h * h + 2e-3,
               fmt::format("reduced integration does not: error of w {:.1e} at h = {:.3g}", reduced_error, h));
}

// Three things to try:
// - thinner: --epsilon 1e-8, or 0, the Bernoulli beam. Full integration does not move; reduced does not notice.
// - refine: --cells 128. The factor 1 + h^2/(12 epsilon) falls to 1.05: full integration wants h^2 << epsilon.
// - the point forces: plot force_reduced of beam.csv; the ends of contact carry 2/5 of the force at epsilon = 0.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.epsilon = 1e-4;
  return tutorial::run(argc, argv, "19_beam", "Timoshenko's beam over an obstacle: full integration locks", options,
                       bend);
}
