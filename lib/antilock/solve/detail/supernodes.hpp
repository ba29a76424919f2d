#pragma once
#include <Eigen/Core>

#include "antilock/core/detail/eigen_memory.hpp"

namespace antilock {

/// A view of the factor L (F x F) of a supernodal Cholesky factorisation: supernode s holds the columns from start[s] to
/// start[s + 1] of L as one dense block by columns. The rows of the block are row[row_start[s]] and following; its own
/// columns come first among them, and above the diagonal the block holds nothing of meaning.
///
/// The two sweeps below are those of CHOLMOD without its copies and without its calls of the BLAS, two per supernode and
/// most of them for a few numbers. Measured on the membrane with its layer (P1), a pair of them against CHOLMOD's: 0.34
/// against 0.47 ms at 1/h = 64, 1.9 against 2.7 at 128, 18 against 22 at 256, where both wait for the memory.
struct Supernodes {
  int size = 0, count = 0;           ///< F; number of supernodes
  const int* start = nullptr;        ///< count + 1
  const int* row_start = nullptr;    ///< count + 1
  const int* block_start = nullptr;  ///< count + 1, in `value`
  const int* row = nullptr;
  const double* value = nullptr;

  void forward(Eigen::VectorXd& y) const;   ///< y <- L^-1 y (F)
  void backward(Eigen::VectorXd& y) const;  ///< y <- L'^-1 y (F)

  /// The trailing block of L (lower triangular) from `first` on.
  Eigen::MatrixXd trailing_block(int first) const;

  /// The pivots of the elimination, the squares of the diagonal of L: F, in the order of L.
  Eigen::VectorXd pivots() const;
};

}  // namespace antilock
