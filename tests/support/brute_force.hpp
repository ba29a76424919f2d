#pragma once
#include <Eigen/Core>
#include <vector>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock::test {

struct BruteForce {
  Eigen::VectorXd u, lambda;
  std::vector<bool> active;
  int answers = 0;  ///< contact sets that satisfy every condition: 1, or the problem is degenerate
};

/// The inequality by trying all sets of bounds that may hold (2^C, 3^C with two sides, 5^C where
/// they give way), dense and in 64-bit mantissas: shares no code and no idea with the solvers of
/// the library. At compliance = 0 it works in the kernel of B, (7), for zero fixed values only; a B
/// of full column rank (complete locking) gives u = 0 and no lambda.
BruteForce brute_force(const VariationalInequality& problem);

}  // namespace antilock::test
