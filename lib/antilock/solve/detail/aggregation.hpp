#pragma once
#include <vector>

#include "antilock/core/matrix.hpp"

namespace antilock {

/// One level of smoothed aggregation of a symmetric K (n x n), by its entries alone.
struct Aggregates {
  std::vector<int> of;        ///< n: the aggregate of each unknown
  SparseMatrix prolongation;  ///< n x n_c: P = (I - 2/3 D^-1 K) P0, P0 = 1 on the members of an aggregate
  SparseMatrix coarse;        ///< n_c x n_c, the upper triangle of P' K P
};

/// Unknowns are neighbours where k_ij^2 > 0.0064 k_ii k_jj. An unknown none of whose neighbours has an aggregate makes one
/// with all of them; the others join that of a neighbour. P. Vanek, J. Mandel, M. Brezina, Computing 56 (1996).
/// `upper`: the upper triangle of K.
Aggregates smoothed_aggregation(const SparseMatrix& upper);

}  // namespace antilock
