#include "common/round_off.hpp"

#include <fmt/format.h>

#include <cmath>

#include "antilock/core/eigenvalues.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/exhibits/summed_matrix.hpp"
#include "antilock/solve/exhibits/uzawa_cg_ilut.hpp"
#include "antilock/solve/kkt.hpp"
#include "antilock/solve/penalised_matrix.hpp"

namespace antilock::tutorial {

Table compare_solvers(const Method& method, const Space& space, const Exact& exact, const Cure& cure) {
  const VariationalInequality problem = assemble(paper_scene(exact.epsilon), space);
  Table rows({"solver", "element", "mesh", "epsilon", "error", "ended", "wrong", "refused", "seconds", "apart"});
  double right = 0;       // the error of the split form
  Eigen::VectorXd split;  // its answer
  const auto add = [&](const std::string& solver, const Eigen::VectorXd& u, const std::string& ended, double seconds) {
    double error = u.size() == 0 ? std::nan("") : 0;
    for (int i = 0; i < u.size(); ++i)
      error = std::max(error, std::abs(u(i) - exact.table.value(space.points()(i, 0), space.points()(i, 1))));
    if (solver == "split form") right = error, split = u;
    const double apart = u.size() == 0 ? std::nan("") : (u - split).lpNorm<Eigen::Infinity>();
    rows.add({solver, method.element->name(), method.family.name, exact.epsilon, error, ended, !(error <= 2 * right),
              ended == "no answer" || ended.ends_with("refused"), seconds, apart / split.lpNorm<Eigen::Infinity>()});
  };
  const auto checked = [&](Solution solution) {
    try {
      certify(problem, solution);
      return solution.warning.empty() ? "trusted" : "warned";
    } catch (const NotConverged&) {
      return "refused";
    }
  };

  Stopwatch watch;
  PenaltyFactor factor(problem);
  const Solution stable = active_set(problem, factor);
  add("split form", stable.u, stable.warning.empty() ? "trusted" : "warned", watch.lap());
  const Eigen::VectorXd cured = cure(problem, stable.active, factor.delta());
  add("cure in 20 lines", cured, "", watch.lap());
  for (const auto& [kind, name] : {std::pair{SummedFactor::cholesky, "sum: Cholesky"}, {SummedFactor::lu, "sum: LU"}}) {
    watch.lap();
    const NaiveAnswer naive = naive_summed_solve(problem, kind);
    const double seconds = watch.lap();
    const bool answered = naive.end != NaiveEnd::refused;  // else the factorisation itself gave up
    add(name, answered ? naive.solution.u : Eigen::VectorXd(),
        answered ? to_string(naive.end) + "; " + checked(naive.solution) : "no answer", seconds);
  }
  watch.lap();
  UzawaOptions patience;
  patience.max_steps = 600;  // steps, not seconds: the same picture on every machine
  try {
    const Solution cg = uzawa_cg_ilut(problem, patience);
    add("sum: CG + ILUT", cg.u, cg.warning.empty() ? "trusted" : "warned", watch.lap());
  } catch (const NotConverged&) {  // the paper's own linear solver gives up, and says so
    add("sum: CG + ILUT", {}, "no answer", watch.lap());
  }
  return rows;
}

Table condition_numbers(const Space& space) {
  Table conditions({"epsilon", "summed", "factored"});
  for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-12, 1e-16}) {
    const VariationalInequality problem = assemble(paper_scene(epsilon), space);
    const FreeNumbering free(problem);
    const SparseMatrix k = penalised_matrix(problem, free, PenaltyFactor(problem).delta());
    const double smallest = smallest_eigenvalue(k);
    const SparseMatrix sum = penalised_matrix(problem, free, problem.compliance);
    conditions.add({epsilon, largest_eigenvalue(sum) / smallest, largest_eigenvalue(k) / smallest});
  }
  return conditions;
}

Table layer_stress_curves() {
  const std::vector<Exact> exact = exact_solutions({1, 1e-1, 1e-2, 0}, 14);
  Table curves({"x", "p_1", "p_01", "p_001", "p_0"});
  for (int j = 0; j <= 200; ++j) {
    const double x = j / 200.0;
    std::vector<Entry> row{x};
    for (const Exact& one : exact) row.emplace_back(one.table.layer_stress(x, -0.5));
    curves.add(row);
  }
  return curves;
}

}  // namespace antilock::tutorial
