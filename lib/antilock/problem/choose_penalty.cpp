#include "antilock/problem/choose_penalty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"

namespace antilock {

double StiffnessRatio::value() const {
  const double s = std::cbrt(trace_a0 / trace_a1) * std::pow(std::cbrt(max_a0 / max_a1), 2);
  return std::isfinite(s) && s > 0 ? s : 1;
}

StiffnessRatio stiffness_ratio(const VariationalInequality& problem) {
  Eigen::VectorXd a1 = problem.a1.diagonal(), a0 = problem.b.cwiseAbs2().transpose() * problem.m;
  for (const int i : problem.dirichlet_dofs) a0(i) = a1(i) = 0;
  const Eigen::VectorXd both = (a0.array() > 0 && a1.array() > 0).cast<double>();
  return {a0.dot(both), a1.dot(both), a0.maxCoeff(), std::max(0.0, a1.maxCoeff())};
}

double penalty_parameter(const VariationalInequality& problem, std::optional<double> penalty) {
  if (penalty && !(*penalty > 0 && std::isfinite(*penalty)))
    throw Error(fmt::format("solve: penalty = {}; accepted: a positive number", *penalty));
  const bool only_fixed_rows =
      problem.parametric_row_count() == 0 && problem.b.rows() > 0;  // no row has the class parameter
  return std::max(only_fixed_rows ? 0 : problem.compliance, penalty ? *penalty : choose_penalty(problem));
}

}  // namespace antilock
