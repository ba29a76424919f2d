#pragma once
#include "antilock/core/matrix.hpp"
#include "antilock/solve/exhibits/summed_matrix.hpp"

namespace antilock {

/// x = K^-1 b by the factor asked for (K symmetric, n x n, both triangles given); empty where the factorisation gives up.
Eigen::VectorXd summed_solve(const SparseMatrix& k, const Eigen::VectorXd& b, SummedFactor kind);

}  // namespace antilock
