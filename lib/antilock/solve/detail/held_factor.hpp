#pragma once
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "antilock/solve/detail/sparse_cholesky.hpp"

namespace antilock {

/// A symmetric positive definite K (F x F) of which some unknowns are held: the factor is that of the others, the rows and
/// columns of the held ones are left with their diagonal alone. One analysis serves every set, so that another set costs
/// one numeric factorisation.
class HeldFactor {
 public:
  HeldFactor();  ///< on DefaultCholesky
  explicit HeldFactor(std::unique_ptr<SparseCholesky> cholesky) : cholesky_(std::move(cholesky)) {}
  /// Takes the upper triangle of K and factors it with nothing held; a later one must have the same pattern. Returns the
  /// row of a lost pivot, as SparseCholesky does.
  std::optional<int> factorise(SparseMatrix&& k);
  /// Throws Error where the rest of K is not positive definite.
  void hold(const std::vector<char>& held);

  /// x = K^-1 r on the unknowns that are not held, 0 on the held ones.
  Eigen::VectorXd solve(const Eigen::VectorXd& r) const;
  Eigen::VectorXd times(const Eigen::VectorXd& x) const;           ///< K x, the whole K
  Eigen::VectorXd absolute_times(const Eigen::VectorXd& x) const;  ///< |K| x
  const SparseMatrix& upper() const { return k_; }
  double smallest_pivot() const { return cholesky_->smallest_pivot(); }

  int refactorisations() const { return refactorisations_; }  ///< so far, each for another set
  double analyse_seconds() const { return analyse_seconds_; }

 private:
  SparseMatrix k_;
  std::vector<char> held_;
  int refactorisations_ = 0;
  double analyse_seconds_ = 0;
  std::unique_ptr<SparseCholesky> cholesky_;
};

}  // namespace antilock
