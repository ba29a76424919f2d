#include "antilock/problem/choose_penalty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

/// How stiff B' M B is beside A1, from their diagonals.
struct RelativeStiffness {
  double sums = 1, largest = 1;  ///< r and R of choose_penalty
  double noise() const { return std::cbrt(sums) * std::pow(std::cbrt(largest), 2); }
};

/// Like stiffnesses are one: then the mesh alone decides. So is what cannot be compared.
double rounded(double stiff, double moderate) {
  const double ratio = stiff / moderate;
  const bool comparable = std::isfinite(ratio) && ratio > 0;
  return !comparable || (ratio > 0.125 && ratio < 8) ? 1 : ratio;
}

RelativeStiffness relative_stiffness(const VariationalInequality& problem) {
  const Eigen::VectorXd a1 = problem.a1.diagonal();
  Eigen::VectorXd a0 = Eigen::VectorXd::Zero(problem.size());
  for (Eigen::Index row = 0; row < problem.b.rows(); ++row)
    for (RowMatrix::InnerIterator b(problem.b, row); b; ++b) a0(b.col()) += problem.m(row) * b.value() * b.value();
  std::vector<char> fixed(problem.size(), 0);
  for (const int i : problem.fixed) fixed[i] = 1;
  double sum_0 = 0, sum_1 = 0, most_0 = 0, most_1 = 0;
  for (int j = 0; j < problem.size(); ++j) {
    if (fixed[j]) continue;
    most_0 = std::max(most_0, a0(j));
    most_1 = std::max(most_1, a1(j));
    if (!(a0(j) > 0 && a1(j) > 0)) continue;
    sum_0 += a0(j);
    sum_1 += a1(j);
  }
  return {rounded(sum_0, sum_1), rounded(most_0, most_1)};
}

}  // namespace

double choose_penalty(const VariationalInequality& problem) {
  if (problem.b.rows() == 0) return 6e-8;  // nothing is penalised
  const RelativeStiffness r = relative_stiffness(problem);
  const double h2 = 2 * problem.m.sum() / static_cast<double>(problem.m.size());
  return std::max(r.sums * std::min({h2, r.sums, 1.0}) / 4096, 6e-8 * r.noise());
}

double smallest_penalty(const VariationalInequality& problem) { return 1e-13 * relative_stiffness(problem).noise(); }

double moderate_delta(const VariationalInequality& problem, std::optional<double> penalty) {
  if (penalty && !(*penalty > 0 && std::isfinite(*penalty)))
    throw Error(fmt::format("solve: penalty = {}; accepted: a positive number", *penalty));
  return std::max(problem.compliance, penalty ? *penalty : choose_penalty(problem));
}

}  // namespace antilock
