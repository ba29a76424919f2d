#include "antilock/solve/coulomb_friction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

void check_arguments(const VariationalInequality& problem, const std::vector<FrictionPair>& pairs,
                     const CoulombOptions& options) {
  if (!(options.coefficient > 0 && std::isfinite(options.coefficient)))
    throw Error(fmt::format("Coulomb friction: coefficient {}; accepted: above 0, finite",
                            options.coefficient));
  const int count = problem.bounds.count();
  for (const auto& [normal, tangential] : pairs)
    if (std::min(normal, tangential) < 0 || std::max(normal, tangential) >= count)
      throw Error(fmt::format(
          "Coulomb friction: a pair of the bounds {} and {}; accepted: indices below {}, the "
          "number of bounds",
          normal, tangential, count));
}

/// F lambda_i of the normal bound of each pair. A force below 0 is round-off.
Eigen::VectorXd limits_of(const Solution& solution, const std::vector<FrictionPair>& pairs,
                          double coefficient) {
  Eigen::VectorXd limits(static_cast<Eigen::Index>(pairs.size()));
  Eigen::Index row = 0;
  for (const FrictionPair& pair : pairs) {
    limits(row) = coefficient * std::max(solution.lambda(pair.normal), 0.0);
    ++row;
  }
  return limits;
}

void set_limits(VariationalInequality& problem, const std::vector<FrictionPair>& pairs,
                const Eigen::VectorXd& limits) {
  Eigen::Index row = 0;
  for (const FrictionPair& pair : pairs) {
    problem.bounds.force_limit(pair.tangential) = limits(row);
    ++row;
  }
}

[[noreturn]] void refuse(const CoulombOptions& options, double change,
                         const FixedPointReport& report, const std::string& why) {
  throw NotConverged(
      fmt::format(
          "Coulomb friction: the fixed point {}: step {} changes the force limits by {:.1e} "
          "of their sum; accepted: a coefficient below {:g}",
          why, report.steps, change, options.coefficient),
      change, report.steps);
}

}  // namespace

CoulombSolution coulomb_friction(
    VariationalInequality& problem, const std::vector<FrictionPair>& pairs,
    const CoulombOptions& options,
    const std::function<Solution(const VariationalInequality&)>& solver) {
  check_arguments(problem, pairs, options);
  constexpr int most_without_progress = 3;
  constexpr double slowest = 0.99;             // at this contraction a digit costs 230 steps
  constexpr double largest_contraction = 0.9;  // of the estimate of the distance
  Eigen::VectorXd limits = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(pairs.size()));
  FixedPointReport report;
  double previous = 0;
  double relative = 0;
  int without_progress = 0;
  while (report.steps < options.max_steps) {
    set_limits(problem, pairs, limits);
    Solution solution = solver(problem);
    ++report.steps;
    const Eigen::VectorXd next = limits_of(solution, pairs, options.coefficient);
    const double total = next.sum();
    const double change = (next - limits).lpNorm<1>();
    if (previous > 0) report.contraction = change / previous;
    const double left = 1 - std::min(report.contraction, largest_contraction);
    if (change <= options.tolerance * left * total) return {std::move(solution), report};
    relative = total > 0 ? change / total : 1;
    const bool progress = report.steps == 1 || change < slowest * previous;
    without_progress = progress ? 0 : without_progress + 1;
    if (without_progress == most_without_progress)
      refuse(options, relative, report, "does not contract");
    previous = change;
    limits = next;
  }
  refuse(options, relative, report,
         fmt::format("contracts too slowly, by the factor {:.2g} per step", report.contraction));
}

}  // namespace antilock
