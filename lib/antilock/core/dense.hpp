#pragma once
#include <Eigen/Core>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

/// These functions call Eigen's decompositions of dense matrices. Each decomposition takes seconds
/// of compilation in every file that uses it. Here all of them are compiled once.

/// The Cholesky factor L of a symmetric positive definite matrix S = L L' (n x n), whose lower
/// triangle is read.
class Cholesky {
 public:
  explicit Cholesky(Eigen::MatrixXd s);
  /// Returns false where a pivot was not positive or not finite. Then every solution is
  /// meaningless.
  bool positive_definite() const { return positive_definite_; }
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;    ///< S^-1 right (n)
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;    ///< S^-1 right (n x any)
  Eigen::VectorXd forward(const Eigen::VectorXd& right) const;  ///< L^-1 right (n)
  Eigen::MatrixXd forward(const Eigen::MatrixXd& right) const;  ///< L^-1 right (n x any)

 private:
  Eigen::MatrixXd l_;
  bool positive_definite_;
};

/// Eigenvalues of a symmetric matrix, smallest first, and their eigenvectors of length 1 (one per
/// column).
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Returns the eigenvalues and eigenvectors of a symmetric matrix (n x n), whose lower triangle is
/// read.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);
/// Returns only the eigenvalues, smallest first (n).
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);
/// Returns the eigenvalues x of A v = x B v, smallest first (n). A is symmetric, B symmetric
/// positive definite, and their lower triangles are read.
Eigen::VectorXd generalised_eigenvalues(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Returns the shortest x that minimises |matrix x - right|, by the complete orthogonal
/// decomposition. Pivots below `threshold` times the largest one count as zero.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right,
                              double threshold);
/// Returns the inverse of Moore and Penrose (n x m) of a matrix (m x n), by the same decomposition
/// with Eigen's threshold.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix);

}  // namespace antilock
