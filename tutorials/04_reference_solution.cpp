// Figure 4. The reference solution, computed as the paper does, and how good it is.
//
// Run: 04_reference_solution   epsilon = 1e-6, h = 1/256; about ten seconds
// Run: 04_reference_solution --epsilon 1 --cells 64
//
// What the picture shows. A hill over the left half of the body, where the load lifts it, a valley
// over the right half, where the load presses it on the obstacle. On the layer "its value along the
// normal to Sigma is constant and nonnegative" (Section 4.1): a ridge that falls to zero at x =
// 0.702 and stays there, in contact.
//
// How. "Unilateral contact problems generally do not admit analytical solution" (Section 4.1), so
// the paper takes the standard method on a very fine uniform mesh, solved by Uzawa's algorithm. The
// contact pressure lambda >= 0 is the multiplier of the condition u >= 0, and one step is
//
//     a(u^k, v) = (f, v) + (lambda^k, v)_{Gamma_C} for all v     the body under a known pressure
//     lambda^{k+1} = max(0, lambda^k - rho u^k)                  more where u < 0, less where u > 0
//
// It is a gradient method for the pressure. The operator behind it is the compliance of Gamma_C
// (pressure in, displacement out). The step rho must stay below 2 / its largest eigenvalue. Let
// kappa be its condition number, the largest by the smallest eigenvalue. With the best rho the
// error falls by (kappa - 1)/(kappa + 1) per step, so that an error of tol takes about (kappa / 2)
// log(1 / tol) steps. kappa grows like 1/h at epsilon = 1 and like 1/h^2 as epsilon -> 0. Count the
// steps below. Each step is cheap here, because the compliance is condensed on Gamma_C once;
// uzawa_cg_ilut (see the end) shows the price when it is not.
//
// For this geometry and load there is a better reference, a sine series (lib/antilock/exact). With
// it the reference itself can be checked.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/uzawa.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/results.hpp"
#include "common/tutorial.hpp"

using namespace antilock;

Table thinned(const std::vector<double>& history);

void reference_solution(const tutorial::Options& options, tutorial::Report& report) {
  const Method p1_structured{&p1(), structured()};

  // 1. A very fine uniform mesh, and the discrete problem (26).
  report.stage("mesh and assembly, 1/h = " + std::to_string(options.cells));
  const Discretisation fine = p1_structured.on(options.cells);
  const VariationalInequality problem = assemble(tutorial::paper_scene(options.epsilon), fine.space());

  // 2. Uzawa. The step comes from an estimate of the compliance's extreme eigenvalues; the
  //    tolerance 1e-8 is far below the discretisation error.
  report.stage("factor");
  PenaltyFactor factor(problem);
  report.stage("Uzawa");
  UzawaOptions uzawa_options;
  uzawa_options.tolerance = 1e-8;
  const Solution solution = uzawa(problem, factor, uzawa_options);

  // 3. The same discrete problem by the active set: a handful of steps, and a check on Uzawa.
  report.stage("active set, same matrix and factor");
  const Solution direct = active_set(problem, factor);
  const double difference = (solution.u - direct.u).cwiseAbs().maxCoeff() / direct.u.cwiseAbs().maxCoeff();

  // 4. The truth.
  report.stage("truth: sine series, and the errors");
  const Errors errors = tutorial::Exact(options.epsilon).errors(fine.space(), solution);

  // 5. How the count of steps grows: the same problem on coarser meshes.
  report.stage("Uzawa on coarser meshes");
  Table steps({"cells", "h", "steps"});
  for (int n = 16; n <= options.cells / 2; n *= 2) {
    const VariationalInequality coarse = assemble(tutorial::paper_scene(options.epsilon), p1_structured.on(n).space());
    steps.add({n, 1.0 / n, uzawa(coarse).counters.contact});
  }
  report.finish();

  tutorial::present(options.out, fine.space(), problem, solution, "reference solution", errors);
  fmt::print("  Uzawa took {} steps, the active set {}; their answers differ by {:.1e} (relative)\n",
             solution.counters.contact, direct.counters.contact, difference);
  steps.print("Uzawa steps against 1/h");
  thinned(solution.history).write(options.out / "history.csv");
  steps.write(options.out / "steps.csv");

  // The verdicts.
  const double h = 1.0 / options.cells, lowest = solution.u(problem.contact).minCoeff();
  report.claim(errors.max_at_unknowns <= h * h, "the reference solution is within {:.1e} of the truth (h^2 = {:.1e})",
               errors.max_at_unknowns, h * h);
  // the step in the gap bounds the error up to the few contact points that it moves: a factor 10 of
  // room
  report.claim(difference <= 10 * uzawa_options.tolerance, "Uzawa and the active set agree to {:.1e}", difference);
  report.claim(lowest >= -1e-7, "nonnegative on Gamma_C (smallest value {:.1e})", lowest);
}

// Three things to try:
// - --epsilon 1, 1e-1, 1e-2 and watch the steps: the stiffer the layer, the more steps Uzawa takes;
//   those of the active set stay as they are.
// - set uzawa_options.step to twice what the estimate gives: it diverges, and says so.
// - replace uzawa by uzawa_cg_ilut (solve/exhibits), the paper's own linear solver, at --epsilon 1
//   --cells 16, then at 1e-6.
int main(int argc, char** argv) {
  tutorial::Options options;
  options.cells = 256;
  return tutorial::run(argc, argv, "04_reference_solution",
                       "Figure 4: the reference solution by Uzawa on a very fine mesh", options, reference_solution);
}

// The steps of Uzawa and the relative step in the gap at each, thinned to what a chart can show.
Table thinned(const std::vector<double>& history) {
  Table table({"step", "relative_step"});
  const std::size_t every = std::max<std::size_t>(1, history.size() / 2000);
  for (std::size_t i = 0; i < history.size(); i += every) table.add({i + 1, history[i]});
  return table;
}
