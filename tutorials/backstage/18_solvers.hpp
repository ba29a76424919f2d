#pragma once
#include <functional>

#include "antilock/core/error.hpp"
#include "antilock/solve/kkt.hpp"
#include "backstage/18_summed.hpp"
#include "common/course.hpp"

namespace antilock::tutorial {

/// Solves with a given contact set and penalty delta.
using Cure =
    std::function<Eigen::VectorXd(const VariationalInequality&, const std::vector<bool>& active, double delta)>;

inline const std::vector<std::string> solver_columns{"solver", "element", "mesh", "epsilon", "error", "ended",
                                                     "wrong",  "refused", "flat", "seconds", "apart"};

/// Every solver on one discrete problem, one row each: the library in split form, a cure with its contact set, the
/// sum by Cholesky and LU, the paper's CG + ILUT. error: the largest at the unknowns; ended: what the solver says
/// of itself; wrong: more than twice the right error, or no answer; refused: what the checks in split form say, or
/// no answer; flat: the largest |u| on Gamma_C over the right one; seconds; apart: the largest distance from the
/// library's answer, relative.
inline Table compare_solvers(const Method& method, const Space& space, const Exact& exact, const Cure& cure) {
  const VariationalInequality problem = assemble(exact.scene, space);
  Table rows(solver_columns);
  double right = 0;       // the error of the split form
  Eigen::VectorXd split;  // its answer
  const auto add = [&](const std::string& solver, const Eigen::VectorXd& u, const std::string& ended, double seconds) {
    double error = u.size() == 0 ? std::nan("") : 0;
    for (int i = 0; i < u.size(); ++i)
      error = std::max(error, std::abs(u(i) - exact.table.value(space.points()(i, 0), space.points()(i, 1))));
    if (solver == "split form") right = error, split = u;
    const double apart = u.size() == 0 ? std::nan("") : (u - split).lpNorm<Eigen::Infinity>();
    rows.add({solver, method.element->name(), method.family.name, exact.epsilon, error, ended, !(error <= 2 * right),
              ended == "no answer" || ended.ends_with("refused"),
              u.size() == 0 ? std::nan("") : u(space.contact()).maxCoeff() / split(space.contact()).maxCoeff(), seconds,
              apart / split.lpNorm<Eigen::Infinity>()});
  };
  const auto checked = [&](Solution solution) {
    try {
      check_kkt(problem, solution);
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

}  // namespace antilock::tutorial
