#pragma once
#include <numeric>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock::test {

/// A1 (full), its load, lower bounds of the first unknowns, and B with M = 1.
inline VariationalInequality small_problem(const Eigen::MatrixXd& a1, const Eigen::VectorXd& load,
                                           const Eigen::VectorXd& lower = {},
                                           const Eigen::MatrixXd& b = {}, double compliance = 1) {
  VariationalInequality problem;
  problem.a1 = a1.sparseView();
  problem.b = b.rows() > 0 ? RowMatrix(b.sparseView()) : RowMatrix(0, a1.cols());
  problem.m = Eigen::VectorXd::Ones(b.rows());
  problem.compliance = compliance;
  problem.load = load;
  std::vector<int> first(static_cast<std::size_t>(lower.size()));
  std::iota(first.begin(), first.end(), 0);
  problem.bounds = Bounds::lower_on(first, lower);
  return problem;
}

/// n x n: 2 on the diagonal, -1 beside it.
inline Eigen::MatrixXd chain(int n) {
  Eigen::MatrixXd a1 = 2 * Eigen::MatrixXd::Identity(n, n);
  a1.diagonal(1).setConstant(-1);
  a1.diagonal(-1).setConstant(-1);
  return a1;
}

}  // namespace antilock::test
