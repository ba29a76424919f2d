#include "antilock/core/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "antilock/core/error.hpp"

namespace antilock {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Cholesky::Cholesky(MatrixXd s) : l_(std::move(s)) {
  const Eigen::LLT<Eigen::Ref<MatrixXd>> in_place(l_);
  positive_definite_ = in_place.info() == Eigen::Success && l_.diagonal().allFinite();
}

VectorXd Cholesky::forward(const VectorXd& right) const {
  return l_.triangularView<Eigen::Lower>().solve(right);
}
MatrixXd Cholesky::forward(const MatrixXd& right) const {
  if (right.cols() == 0)
    return right;  // Eigen refers to the first entry, here and in solve, whether there is one or
                   // not
  return l_.triangularView<Eigen::Lower>().solve(right);
}

VectorXd Cholesky::solve(const VectorXd& right) const {
  VectorXd x = forward(right);
  l_.transpose().triangularView<Eigen::Upper>().solveInPlace(x);
  return x;
}

MatrixXd Cholesky::solve(const MatrixXd& right) const {
  if (right.cols() == 0) return right;
  MatrixXd x = forward(right);
  l_.transpose().triangularView<Eigen::Upper>().solveInPlace(x);
  return x;
}

SymmetricEigen symmetric_eigen(const MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(matrix);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

VectorXd symmetric_eigenvalues(const MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

VectorXd generalised_eigenvalues(const MatrixXd& a, const MatrixXd& b) {
  const Cholesky factor(b);  // L^-1 A L^-T has them
  if (!factor.positive_definite())
    throw Error("eigenvalues of A x = s B x: B is not positive definite");
  const MatrixXd half = factor.forward(MatrixXd(a.selfadjointView<Eigen::Lower>()));
  return symmetric_eigenvalues(factor.forward(MatrixXd(half.transpose())));
}

VectorXd least_squares(const MatrixXd& matrix, const VectorXd& right, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver;
  solver.setThreshold(threshold);
  solver.compute(matrix);
  return solver.solve(MatrixXd(right));
}

MatrixXd pseudo_inverse(const MatrixXd& matrix) {
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver(matrix);
  return solver.solve(MatrixXd(MatrixXd::Identity(matrix.rows(), matrix.rows())));
}

}  // namespace antilock
