#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "antilock/solve/detail/sparse_cholesky.hpp"

namespace antilock {

/// A symmetric positive definite K (F x F) of which some unknowns may be held: the factor is that of the others, the rows
/// and columns of the held ones are left with their diagonal alone. One analysis serves every set, so that another set
/// costs one numeric factorisation.
class HeldFactor {
 public:
  explicit HeldFactor(CholeskyMaker make = default_cholesky) : cholesky_(make()) {}
  /// Takes the upper triangle of K and factors it with nothing held; a later one must have the same pattern, and `last`
  /// is of the first alone. Returns the row of a lost pivot. All as SparseCholesky.
  std::optional<int> factorise(SparseMatrix&& k, int last = 0);
  /// Throws Error where the rest of K is not positive definite.
  void hold(const std::vector<char>& held);

  /// x = K^-1 r on the unknowns that are not held, 0 on the held ones.
  Eigen::VectorXd solve(const Eigen::VectorXd& r) const;
  Eigen::VectorXd times(const Eigen::VectorXd& x) const;           ///< K x, the whole K
  Eigen::VectorXd absolute_times(const Eigen::VectorXd& x) const;  ///< |K| x
  const SparseMatrix& upper() const { return k_; }
  const SparseCholesky& cholesky() const { return *cholesky_; }

  int factorisations() const { return factorisations_; }       ///< so far
  double analyse_seconds() const { return analyse_seconds_; }  ///< of the one analysis
  double factor_seconds() const { return factor_seconds_; }    ///< of the last `factorise`

 private:
  SparseMatrix k_;
  std::vector<char> held_;
  int factorisations_ = 0;
  double analyse_seconds_ = 0, factor_seconds_ = 0;
  std::unique_ptr<SparseCholesky> cholesky_;
};

}  // namespace antilock
