#include "antilock/solve/detail/held_factor.hpp"

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/solve/detail/default_cholesky.hpp"

namespace antilock {

HeldFactor::HeldFactor() : HeldFactor(std::make_unique<DefaultCholesky>()) {}

std::optional<int> HeldFactor::factorise(SparseMatrix&& k) {
  k_.swap(k);  // Eigen 3.4 copies a sparse matrix that is moved
  held_.assign(k_.cols(), 0);
  if (!cholesky_->analysed()) {
    Stopwatch watch;
    cholesky_->analyse(k_, 0);
    analyse_seconds_ = watch.seconds();
  }
  return cholesky_->factorise(k_);
}

void HeldFactor::hold(const std::vector<char>& held) {
  if (held == held_) return;
  SparseMatrix rest = k_;
  for (Eigen::Index j = 0; j < rest.cols(); ++j)
    for (SparseMatrix::InnerIterator it(rest, j); it; ++it)
      if (it.row() != j && (held[j] != 0 || held[it.row()] != 0)) it.valueRef() = 0;
  held_ = held;
  ++refactorisations_;
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
  Eigen::VectorXd product = Eigen::VectorXd::Zero(x.size());
  for (Eigen::Index j = 0; j < k_.cols(); ++j)
    for (SparseMatrix::InnerIterator it(k_, j); it; ++it) {
      const double size = std::abs(it.value());
      product(it.row()) += size * x(j);
      if (it.row() != j) product(j) += size * x(it.row());
    }
  return product;
}

}  // namespace antilock
