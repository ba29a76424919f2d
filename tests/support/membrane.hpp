#pragma once
#include <vector>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock::test {

/// A membrane on the unit square over an obstacle, every inner vertex bounded: P1 on the structured
/// mesh of n x n squares, whose matrix is the five-point star. f = -8 everywhere; the obstacle is a
/// paraboloid in the middle and far below at the rim, so that the membrane lies on a disc of it.
/// Rows x columns of vertices; (n - 1)^2 unknowns.
inline VariationalInequality membrane_over_obstacle(int n) {
  const int m = n - 1, size = m * m;
  const double h = 1.0 / n;
  std::vector<Eigen::Triplet<double>> entries;
  VariationalInequality problem;
  problem.load = Eigen::VectorXd::Constant(size, -8 * h * h);
  std::vector<int> all;
  Eigen::VectorXd lower(size);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) {
      const int k = i * m + j;
      entries.emplace_back(k, k, 4);
      if (i > 0) entries.emplace_back(k, k - m, -1);
      if (i + 1 < m) entries.emplace_back(k, k + m, -1);
      if (j > 0) entries.emplace_back(k, k - 1, -1);
      if (j + 1 < m) entries.emplace_back(k, k + 1, -1);
      const double x = (j + 1) * h - 0.5, y = (i + 1) * h - 0.5;
      all.push_back(k);
      lower(k) = -0.1 - 1.5 * (x * x + y * y);
    }
  problem.a1.resize(size, size);
  problem.a1.setFromTriplets(entries.begin(), entries.end());
  problem.b.resize(0, size);
  problem.bounds = Bounds::lower_on(all, lower);
  return problem;
}

}  // namespace antilock::test
