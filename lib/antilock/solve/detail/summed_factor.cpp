#include "antilock/solve/detail/summed_factor.hpp"

#include <Eigen/CholmodSupport>
#include <Eigen/UmfPackSupport>

namespace antilock {

Eigen::VectorXd summed_solve(const SparseMatrix& k, const Eigen::VectorXd& b, SummedFactor kind) {
  Eigen::VectorXd x;
  if (kind == SummedFactor::cholesky) {
    Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Upper> factor;
    factor.cholmod().print = 0;
    factor.compute(k);
    if (factor.info() == Eigen::Success) x = factor.solve(b);
  } else {
    const Eigen::UmfPackLU<SparseMatrix> factor(k);
    if (factor.info() == Eigen::Success) x = factor.solve(b);
  }
  return x.allFinite() ? x : Eigen::VectorXd();
}

}  // namespace antilock
