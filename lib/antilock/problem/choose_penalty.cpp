#include "antilock/problem/choose_penalty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"

namespace antilock {

double RelativeStiffness::value() const {
  const double s = std::cbrt(sum_0 / sum_1) * std::pow(std::cbrt(most_0 / most_1), 2);
  return std::isfinite(s) && s > 0 ? s : 1;
}

RelativeStiffness relative_stiffness(const VariationalInequality& problem) {
  const Eigen::VectorXd a1 = problem.a1.diagonal();
  Eigen::VectorXd a0 = problem.b.cwiseAbs2().transpose() * problem.m;
  for (const int i : problem.fixed) a0(i) = -1;
  RelativeStiffness s;
  for (int j = 0; j < problem.size(); ++j) {
    if (a0(j) < 0) continue;
    s.most_0 = std::max(s.most_0, a0(j));
    s.most_1 = std::max(s.most_1, a1(j));
    if (!(a0(j) > 0 && a1(j) > 0)) continue;
    s.sum_0 += a0(j);
    s.sum_1 += a1(j);
  }
  return s;
}

double moderate_delta(const VariationalInequality& problem, std::optional<double> penalty) {
  if (penalty && !(*penalty > 0 && std::isfinite(*penalty)))
    throw Error(fmt::format("solve: penalty = {}; accepted: a positive number", *penalty));
  return std::max(problem.compliance, penalty ? *penalty : choose_penalty(problem));
}

}  // namespace antilock
