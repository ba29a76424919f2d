#pragma once
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// Returns the Gram matrix G of the discrete dual norm of multipliers q, one value per row of B
/// (the dual Schur complement):
///
///     q' G q = sup_v (q, B v)_M^2 / norm(v, v)   over the free v,   G = M B norm^-1 B' M
///
/// `norm` is the N x N Gram matrix of the norm of the space. A multiplier is constant on `merged`
/// successive rows of B, for example on the triangles of a refined mesh with one ancestor. G is
/// dense and has R / merged rows, R the number of rows of B. Throws Error for a malformed problem,
/// a norm that is not positive definite, and sizes that do not fit.
Eigen::MatrixXd multiplier_gram(const VariationalInequality& problem, const SparseMatrix& norm,
                                int merged = 1);

/// Returns the discrete inf-sup constant of B, the largest beta >= 0 with
///
///     sup_v (q, B v)_M / |v| >= beta |q|   for all multipliers q.
///
/// beta^2 is the smallest eigenvalue of space_gram q = beta^2 norm_gram q. space_gram is the
/// multiplier_gram of the space, norm_gram the Gram matrix of the norm of the multipliers: M for
/// L2, or the multiplier_gram of a much finer space for the dual norm of the theory. Returns 0
/// where rows of B depend on each other. Throws Error where norm_gram is not positive definite. The
/// eigenvalues are computed densely, which is practical for up to some 1000 multipliers.
double inf_sup(const Eigen::MatrixXd& space_gram, const Eigen::MatrixXd& norm_gram);

}  // namespace antilock
