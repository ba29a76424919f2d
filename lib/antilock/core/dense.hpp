#pragma once
#include <Eigen/Core>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

/// Eigen's decompositions of dense matrices behind plain functions. Each one costs seconds of compilation where it is
/// used; here all of them are compiled once.

/// S = L L', the Cholesky factor of a symmetric positive definite matrix (n x n), of which the lower triangle is read.
class Cholesky {
 public:
  explicit Cholesky(Eigen::MatrixXd s);
  /// False where a pivot was not positive or not finite; every solution is meaningless then.
  bool positive_definite() const { return positive_definite_; }
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;    ///< S^-1 right (n)
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;    ///< S^-1 right (n x any)
  Eigen::VectorXd forward(const Eigen::VectorXd& right) const;  ///< L^-1 right (n)
  Eigen::MatrixXd forward(const Eigen::MatrixXd& right) const;  ///< L^-1 right (n x any)

 private:
  Eigen::MatrixXd l_;
  bool positive_definite_;
};

/// Eigenvalues of a symmetric matrix, smallest first, and their eigenvectors of length 1 (one per column).
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Of a symmetric matrix (n x n), of which the lower triangle is read.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);
/// The eigenvalues alone, smallest first (n).
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);
/// The x of A v = x B v, smallest first (n): A symmetric, B symmetric positive definite, their lower triangles read.
Eigen::VectorXd generalised_eigenvalues(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// The shortest x that minimises |matrix x - right|, by the complete orthogonal decomposition: pivots below `threshold`
/// times the largest one count as zero.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right, double threshold);
/// Moore and Penrose's inverse (n x m) of a matrix (m x n), by the same decomposition with Eigen's threshold.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix);

}  // namespace antilock
