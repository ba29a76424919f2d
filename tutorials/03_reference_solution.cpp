// Figure 4. The reference solution, computed as the paper does, and how good it is.
//
// Run: 03_reference_solution                          epsilon = 1e-6, h = 1/256; about ten seconds
// Run: 03_reference_solution --epsilon 1 --cells 64
//
// What the picture shows. A hill over the left half of the body, where the load lifts it, a valley over the right half,
// where the load presses it on the obstacle. On the layer "its value along the normal to Sigma is constant and
// nonnegative" (Section 4.1): a ridge that falls to zero at x = 0.702 and stays there, in contact.
//
// How. "Unilateral contact problems generally do not admit analytical solution", so the paper takes the standard method
// on a very fine uniform mesh, solved by Uzawa's algorithm: with the contact pressure lambda >= 0 as a multiplier,
//
//     a(u^k, v) = (f, v) + (lambda^k, v)_{Gamma_C} for all v         an elastic body under a known pressure
//     lambda^{k+1} = max(0, lambda^k - rho u^k)                      more pressure where it sinks in, less where it
//     lifts
//
// It is a gradient method for the pressure. The operator behind it is the compliance of Gamma_C (pressure in,
// displacement out); the step rho must stay below 2 / its largest eigenvalue, and the number of steps is its condition
// number, which grows like 1/h at epsilon = 1 and like 1/h^2 as epsilon -> 0. Count the steps below. Each one is cheap
// here, because the compliance is condensed on Gamma_C once; uzawa_cg_ilut (see the end) pays the price when it is not.
//
// For this geometry and load there is a better reference, a sine series (lib/antilock/exact): so the reference itself
// can be checked.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <fmt/format.h>

#include "antilock/exact/truth_table.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/exhibits/uzawa_cg_ilut.hpp"
#include "antilock/solve/uzawa.hpp"
#include "common/results.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

Scene make_scene(double epsilon) { return Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{}); }

// The steps of Uzawa and the relative step in the gap at each, thinned to what a chart can show.
void write_history(const std::filesystem::path& path, const std::vector<double>& history) {
  const std::size_t every = std::max<std::size_t>(1, history.size() / 2000);
  std::vector<Eigen::RowVector2d> kept;
  for (std::size_t i = 0; i < history.size(); i += every) kept.emplace_back(static_cast<double>(i + 1), history[i]);
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(kept.size()), 2);
  for (std::size_t i = 0; i < kept.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = kept[i];
  write_csv(path, {"step", "relative_step"}, rows);
}

// How the count of steps grows: the same problem on coarser meshes.
void steps_against_h(double epsilon, int cells, tutorial::Report& report) {
  std::vector<std::pair<int, int>> counts;
  for (int n = 16; n <= cells / 2; n *= 2) {
    report.stage("Uzawa on 1/h = " + std::to_string(n));
    const TriangleMesh mesh = structured_mesh(n);
    const Space space(mesh, p1());
    counts.emplace_back(n, uzawa(assemble(make_scene(epsilon), space)).counters.contact);
  }
  report.finish();
  fmt::print("\n  Uzawa steps against 1/h:");
  for (const auto& [n, steps] : counts) fmt::print("   {}: {}", n, steps);
  fmt::print("\n");
}

void reference_solution(const tutorial::Options& options, tutorial::Report& report) {
  // 1. A very fine uniform mesh.
  report.stage("mesh, 1/h = " + std::to_string(options.cells));
  const TriangleMesh mesh = structured_mesh(options.cells);
  const Space space(mesh, p1());

  // 2. The discrete problem (26).
  report.stage("assemble");
  const VariationalInequality problem = assemble(make_scene(options.epsilon), space);

  // 3. Uzawa. The step comes from an estimate of the compliance's extreme eigenvalues; the tolerance 1e-8 is far below
  // the
  //    discretisation error.
  report.stage("factor");
  PenaltyFactor factor(problem);
  report.stage("Uzawa");
  UzawaOptions uzawa_options;
  uzawa_options.tolerance = 1e-8;
  const Solution solution = uzawa(problem, factor, uzawa_options);

  // 4. The same discrete problem by the active set: a handful of steps, and a check on Uzawa.
  report.stage("active set, same matrix and factor");
  const Solution direct = active_set(problem, factor);

  // 5. The truth.
  report.stage("truth: sine series");
  const Truth truth(paper_sine_load(), options.epsilon);
  const TruthTable table(truth);
  report.stage("errors");
  const Errors errors = measure_errors(space, solution, options.epsilon, reference(table));
  report.finish();

  fmt::print("\n");
  tutorial::print_solution(space, problem, solution);
  tutorial::print_errors("reference solution", errors);
  const double difference = (solution.u - direct.u).cwiseAbs().maxCoeff() / direct.u.cwiseAbs().maxCoeff();
  fmt::print("  Uzawa took {} steps, the active set {}; their answers differ by {:.1e} (relative)\n",
             solution.counters.contact, direct.counters.contact, difference);
  steps_against_h(options.epsilon, options.cells, report);
  fmt::print("\n");

  report.stage("write files");
  tutorial::write_results(options.out, space, problem, solution);
  write_history(options.out / "history.csv", solution.history);
  report.finish();

  // The verdicts.
  const double h = 1.0 / options.cells;
  report.claim(errors.max_at_unknowns <= h * h,
               fmt::format("the reference solution is within {:.1e} of the truth (h^2 = {:.1e})",
                           errors.max_at_unknowns, h * h));
  // the step in the gap bounds the error up to the few contact points that it moves: a factor 10 of room
  report.claim(difference <= 10 * uzawa_options.tolerance,
               fmt::format("Uzawa and the active set agree to {:.1e}", difference));
  double lowest = 0;
  for (const int i : problem.contact) lowest = std::min(lowest, solution.u(i));
  report.claim(lowest >= -1e-7, fmt::format("nonnegative on Gamma_C (smallest value {:.1e})", lowest));
}

// Three things to try:
// - --epsilon 1, 1e-1, 1e-2 and watch the steps: the stiffer the layer, the longer Uzawa crawls; the active set does
// not notice.
// - set uzawa_options.step to twice what the estimate gives: it diverges, and says so.
// - replace uzawa by uzawa_cg_ilut, the paper's own linear solver, at --epsilon 1 --cells 16, then at 1e-6.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.cells = 256;
  return tutorial::run(argc, argv, "03_reference_solution",
                       "Figure 4: the reference solution by Uzawa on a very fine mesh", options, reference_solution);
}
