#pragma once
#include <Eigen/Core>
#include <limits>
#include <optional>

#include "antilock/core/matrix.hpp"

namespace antilock {

/// Sparse Cholesky factor L L' = P K P' of a symmetric positive definite K (F x F), of which the upper triangle is read.
/// What the solvers ask of a factor; `CholmodCholesky` and `EigenCholesky` answer alike, to round-off.
class SparseCholesky {
 public:
  virtual ~SparseCholesky() = default;

  /// A pivot below this part of its diagonal entry of K is nothing but the round-off of that entry. Sound problems stay
  /// above 1e-12, on meshes and layers of every kind.
  static constexpr double lost_pivot = 64 * std::numeric_limits<double>::epsilon();

  /// Orders and analyses the pattern of K. `last` > 0: the last rows of K stay the last ones, in their order, and the
  /// factor's own ordering is for the rest. Throws Error out of memory.
  virtual void analyse(SparseMatrix& k, int last) = 0;
  virtual bool analysed() const = 0;

  /// A numeric factorisation of a matrix of the analysed pattern. Returns the row of K whose pivot is not positive or
  /// nothing but round-off (`lost_pivot`); empty: K is positive definite. Throws Error out of memory.
  virtual std::optional<int> factorise(SparseMatrix& k) = 0;

  /// The smallest pivot: to about a factor of F the smallest eigenvalue of K, for next to nothing. Infinite of no rows.
  virtual double smallest_pivot() const = 0;
  virtual Eigen::VectorXd forward(const Eigen::VectorXd& r) const = 0;  ///< y = L^-1 P r
  virtual Eigen::VectorXd backward(Eigen::VectorXd y) const = 0;        ///< x = P' L'^-1 y
  /// The trailing block of L (lower triangular) from place `first` of the order on.
  virtual Eigen::MatrixXd trailing_block(int first) const = 0;
};

}  // namespace antilock
