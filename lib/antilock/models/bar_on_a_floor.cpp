#include "antilock/models/bar_on_a_floor.hpp"

#include <numeric>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

VariationalInequality bar_on_a_floor(int n, double pull) {
  VariationalInequality bar;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i)
    for (const int j : {i, i + 1})
      for (const int k : {i, i + 1}) entries.emplace_back(j, k, j == k ? n : -n);
  bar.a1.resize(n + 1, n + 1);
  bar.a1.setFromTriplets(entries.begin(), entries.end());
  bar.b.resize(0, n + 1);
  bar.load = pull * Eigen::VectorXd::Unit(n + 1, n);
  bar.dirichlet_dofs = {0};
  bar.dirichlet_values = Eigen::VectorXd::Zero(1);
  std::vector<int> nodes(n);
  std::iota(nodes.begin(), nodes.end(), 1);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  bar.bounds = {nodes, {zero, zero, Eigen::VectorXd::Constant(n, 1.0 / n)}};
  bar.bounds.force_limit(n - 1) = 0.5 / n;
  return bar;
}

}  // namespace antilock
