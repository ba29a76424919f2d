#pragma once
#include <Eigen/Core>

namespace antilock::test {

/// Products of dense matrices, compiled once: written as an expression each costs its test a second
/// or two of compilation.
Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// B' diag(m) B.
Eigen::MatrixXd gram(const Eigen::MatrixXd& b, const Eigen::VectorXd& m);
/// The x of A x = right, A any regular matrix, by L U with full pivoting: shares nothing with the
/// library.
Eigen::VectorXd lu_solve(const Eigen::MatrixXd& a, const Eigen::VectorXd& right);

}  // namespace antilock::test
