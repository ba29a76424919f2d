#include "support/dense.hpp"

#include <Eigen/LU>

namespace antilock::test {

Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return a * b; }

Eigen::MatrixXd gram(const Eigen::MatrixXd& b, const Eigen::VectorXd& m) {
  const Eigen::MatrixXd weighted = m.asDiagonal() * b;
  return product(b.transpose(), weighted);
}

Eigen::VectorXd lu_solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& right) {
  return a.fullPivLu().solve(right);
}

}  // namespace antilock::test
