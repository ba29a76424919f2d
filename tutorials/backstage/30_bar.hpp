#pragma once
#include "antilock/problem/variational_inequality.hpp"

namespace antilock::tutorial {

/// A bar of stiffness 1, held at x = 0, pulled by `pull` at x = 1, on a floor with g = 1 per length: it slips on the
/// last `pull` of it, u = (x - 1 + pull)^2 / 2 there.
inline VariationalInequality bar_on_a_floor(int n, double pull) {
  VariationalInequality bar;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i)
    for (const int j : {i, i + 1})
      for (const int k : {i, i + 1}) entries.emplace_back(j, k, j == k ? n : -n);
  bar.a1.resize(n + 1, n + 1);
  bar.a1.setFromTriplets(entries.begin(), entries.end());
  bar.b.resize(0, n + 1);
  bar.load = pull * Eigen::VectorXd::Unit(n + 1, n);
  bar.fixed = {0};
  bar.fixed_values = Eigen::VectorXd::Zero(1);
  for (int i = 1; i <= n; ++i) bar.contact.push_back(i);
  bar.lower = bar.upper = Eigen::VectorXd::Zero(n);
  bar.force_bound = Eigen::VectorXd::Constant(n, 1.0 / n);
  bar.force_bound(n - 1) = 0.5 / n;
  return bar;
}

}  // namespace antilock::tutorial
