#include "antilock/solve/detail/sparse_cholesky.hpp"

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"

namespace antilock {

std::optional<int> HeldFactor::factorise(SparseMatrix&& k, int last) {
  k_.swap(k);  // Eigen 3.4 copies a sparse matrix that is moved
  held_.assign(k_.cols(), 0);
  Stopwatch watch;
  if (factorisations_++ == 0) {
    cholesky_->analyse(k_, last);
    analyse_seconds_ = watch.lap();
  }
  const std::optional<int> lost = cholesky_->factorise(k_);
  factor_seconds_ = watch.lap();
  return lost;
}

void HeldFactor::hold(const std::vector<char>& held) {
  if (held == held_) return;
  SparseMatrix rest = k_;
  for (Eigen::Index j = 0; j < rest.cols(); ++j)
    for (SparseMatrix::InnerIterator it(rest, j); it; ++it)
      if (it.row() != j && (held[j] != 0 || held[it.row()] != 0)) it.valueRef() = 0;
  held_ = held;
  ++factorisations_;
  if (cholesky_->factorise(rest)) throw Error("contact: K on the unknowns that are not held is not positive definite");
}

Eigen::VectorXd HeldFactor::solve(const Eigen::VectorXd& r) const {
  Eigen::VectorXd x = cholesky_->backward(cholesky_->forward(r));
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (held_[i] != 0) x(i) = 0;
  return x;
}

Eigen::VectorXd HeldFactor::times(const Eigen::VectorXd& x) const { return k_.selfadjointView<Eigen::Upper>() * x; }

Eigen::VectorXd HeldFactor::absolute_times(const Eigen::VectorXd& x) const {
  const SparseMatrix sizes = k_.cwiseAbs();
  return sizes.selfadjointView<Eigen::Upper>() * x;
}

}  // namespace antilock
