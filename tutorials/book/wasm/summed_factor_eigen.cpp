// The exhibit's factor where neither CHOLMOD nor UMFPACK is to be had: Eigen's own, whichever is asked for.
#include <Eigen/SparseCholesky>

#include "antilock/solve/detail/summed_factor.hpp"

namespace antilock {

Eigen::VectorXd summed_solve(const SparseMatrix& k, const Eigen::VectorXd& b, SummedFactor) {
  const Eigen::SimplicialLLT<SparseMatrix, Eigen::Upper> factor(k);
  Eigen::VectorXd x;
  if (factor.info() == Eigen::Success) x = factor.solve(b);
  return x.allFinite() ? x : Eigen::VectorXd();
}

}  // namespace antilock
