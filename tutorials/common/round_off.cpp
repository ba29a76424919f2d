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

Table sums(const Table& results) {
  Table naive = results.where("solver", "sum: Cholesky");
  naive.add(results.where("solver", "sum: LU"));
  return naive;
}

void show_round_off(const std::filesystem::path& out, const Table& results, const Table& conditions) {
  results.where("element", "P1").pivot("epsilon", "solver", "error").print("P1 structured: error at the unknowns", 3);
  results.where("element", "P1")
      .pivot("epsilon", "solver", "ended")
      .print("how they ended, and what the checks in split form say");
  conditions.print("condition number of the sum, and of the K that is factored", 2);
  results.select({"solver", "element", "mesh", "epsilon", "error", "ended", "seconds"}).write(out / "results.csv");
  layer_stress_curves().write(out / "stress.csv");
}

void judge_split_form(const Table& results, const Table& conditions, Report& report) {
  // From 1e-3 on the truth changes by less than a percent of the error: (epsilon / h)^2 of it.
  const Table split = results.where("solver", "split form"),
              small = split.where_number("epsilon", [](double e) { return e <= 1e-3; });
  for (const Entry& element : small.different("element"))
    for (const Entry& mesh : small.where("element", element).different("mesh")) {
      const Table own = small.where("element", element).where("mesh", mesh);
      report.claim(own.most("error") < 1.01 * own.least("error"),
                   "{} {}: split form, error {:.2e} to {:.2e} below epsilon = 1e-3", element.text(), mesh.text(),
                   own.least("error"), own.most("error"));
    }
  // What the condition number foretells: 1.1e-16 of it bounds the relative error, up to a factor of 10 each way.
  const Table naive = sums(results);
  for (const Table& row : conditions.rows()) {
    const double lost = 1.1e-16 * row.number("summed");
    const Table here = naive.where("element", "P1").where("epsilon", row.entry("epsilon"));
    if (lost > 10 || lost < 0.05)
      report.claim(here.where("wrong", lost > 10 ? 0 : 1).size() == 0,
                   "epsilon = {:g}: round-off times condition is {:.0e}, the sum is {}", row.number("epsilon"), lost,
                   lost > 10 ? "wrong" : "right");
  }
  const Table stiff = conditions.where_number("epsilon", [](double epsilon) { return epsilon <= 1e-4; });
  report.claim(stiff.most("factored") < 1.01 * stiff.least("factored"),
               "condition number of K: {:.0e} from epsilon = 1e-4 on", stiff.most("factored"));
}

}  // namespace antilock::tutorial
