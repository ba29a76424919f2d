#pragma once
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// Gram matrix of what a space can see of multipliers q, one value per row of B:
///     q' G q = sup_v (q, B v)_M^2 / norm(v, v)   over the free v,   G = M B norm^-1 B' M.
/// `norm`: N x N Gram matrix of the space's norm. `merged` rows of B in turn share one multiplier (the triangles of a
/// refined mesh inside their ancestor): G is R / merged square, dense. Throws Error for a malformed problem, a norm
/// that is not positive definite, sizes that do not fit.
Eigen::MatrixXd multiplier_gram(const VariationalInequality& problem, const SparseMatrix& norm, int merged = 1);

/// The discrete inf-sup constant of B: the smallest beta >= 0 with
///     sup_v (q, B v)_M / |v| = beta |q|   for some q,   that is  seen q = beta^2 norm q.
/// seen: multiplier_gram of the space; norm: Gram matrix of the multipliers' own norm (M for L2; multiplier_gram of a
/// much finer space for the dual norm of the theory). 0 where rows of B depend on each other. Throws Error where norm
/// is not positive definite. Dense: for some 1000 multipliers.
double inf_sup(const Eigen::MatrixXd& space_gram, const Eigen::MatrixXd& norm_gram);

}  // namespace antilock
