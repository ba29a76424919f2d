#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>

#include "antilock/core/matrix.hpp"

namespace antilock {

/// Sparse Cholesky factor L L' = P K P' of a symmetric positive definite K (F x F), of which the upper triangle is read.
/// The one page that knows CHOLMOD (supernodal).
class SparseCholesky {
 public:
  SparseCholesky();
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// Orders and analyses the pattern of K. `last` > 0: the last rows of K stay the last ones, in their order, and a
  /// minimum degree under that constraint orders the rest (CAMD: as good as AMD without it). 0: CHOLMOD's own choice.
  /// Throws Error out of memory.
  void analyse(SparseMatrix& k, int last);
  bool analysed() const;

  /// A numeric factorisation of a matrix of the analysed pattern. Returns the row of K whose pivot is not positive or
  /// nothing but round-off; empty: K is positive definite. Throws Error out of memory.
  std::optional<int> factorise(SparseMatrix& k);

  /// Smallest by largest pivot: an upper estimate of 1 / condition number, for next to nothing.
  double rcond() const;
  Eigen::VectorXd forward(const Eigen::VectorXd& r) const;  ///< y = L^-1 P r
  Eigen::VectorXd backward(Eigen::VectorXd y) const;        ///< x = P' L'^-1 y
  /// The trailing block of L (lower triangular) from place `first` of the order on.
  Eigen::MatrixXd trailing_block(int first) const;

 private:
  struct Cholmod;
  std::unique_ptr<Cholmod> cholmod_;
};

}  // namespace antilock
