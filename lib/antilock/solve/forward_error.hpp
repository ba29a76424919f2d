#pragma once
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/residual.hpp"

namespace antilock {

/// The estimated forward error of an iterate u: its distance from the exact solution of the
/// discrete problem. The residuals r1 and r2 of a correction are computed with 106 bits
/// (residual.hpp). So a correction vanishes only at the exact solution, and a rounded factor slows
/// the corrections down but does not change their limit. Therefore the error of u is the sum of the
/// corrections to come. Let `next` estimate the next correction. If each later one is `rate` times
/// the one before, the sum is the geometric series next / (1 - rate). Both are measured: `rate` is
/// Anderson::contraction, and `next` is the larger one of rate times the last correction and of
/// Anderson::next_affine_image_step (anderson.hpp). Where B has no rows, `rate` is the quotient of
/// the last two corrections, and at first factor_roundoff(). LAPACK's xGERFSX estimates the errors
/// of its solutions in the same way.
struct ForwardError {
  /// next / (1 - rate) divided by U = max(|u|, eps largest / tolerance), in the maximum norm, with
  /// largest = max(|u|, Solution::penalised_max_u). The second term of U matters for a u that has
  /// locked. The iteration need not reduce the error of such a u below eps largest, which is about
  /// the round-off of the unlocked u. Divided by this U, an error of that size is equal to the
  /// tolerance.
  double relative = 1;
  double constraint = 1;  ///< the largest |r2_j| over the tolerance of row j, see forward_error()
  double absolute = 0;    ///< next / (1 - rate), plus the largest |r2_j| / sum_k |B_jk|
  /// Returns whether the iteration may stop.
  bool within(double tolerance) const { return relative <= tolerance && constraint <= 1; }
};

/// Estimates the forward error of u (N) after a correction. `next_correction` is `next` and
/// `contraction` is `rate` of ForwardError, both in the maximum norm. `largest_u` is
/// Solution::penalised_max_u. `constraint_residual` (R) is r2 = compliance p - B u, which after a
/// correction is (compliance - delta) dp exactly. Row j counts as satisfied where
///
///     |r2_j| <= t U sum_k |B_jk|
///     t = max(defaults::row_tolerance max(1, tolerance / 1e-10), contact_tolerance)
///
/// and constraint_defect() below estimates the error of u that such a residual may hide. The
/// problem may be infeasible if a row of B has the compliance 0 and u = 0 is not admissible. Then
/// |r2_j| must also be at most CorrectionOptions::kkt_fail() times min(sum_k |B_jk u_k|, d sum_k
/// |B_jk|), up to the round-off of 106 bits. Here d is the largest finite bound or prescribed
/// value. Otherwise a large u would hide a constraint that cannot be satisfied.
ForwardError forward_error(const VariationalInequality& problem, const DoubleDoubleVector& u,
                           double next_correction, const Eigen::VectorXd& constraint_residual,
                           double contraction, double largest_u, const CorrectionOptions& options);

/// Throws NotConverged where y (R) proves by Farkas's lemma (forward_error.cpp) that no admissible
/// u has max |u| <= max_u. y is the part of the residual of B u = 0 that does not decay, and u (N)
/// is the iterate with this residual. There are two calls. The first is made while the corrections
/// are slow, with y = M B u. Since u may still grow, max_u is then the largest |u| so far divided
/// by sqrt(eps). This should suffice, since u at the true compliance is hardly larger than u with
/// the penalty (expected, not proved). The second call is made for a solution. y is then
/// ConstraintDefect::infeasible_part, and max_u is slightly above the largest |u|.
void throw_if_infeasible(const VariationalInequality& problem, const DoubleDoubleVector& y,
                         const Eigen::VectorXd& u, double max_u, const Solution& so_far);

/// Estimates the round-off of one solve relative to u where B has no rows, so that K is A1: n_free
/// eps cond(K). cond(K) is estimated from below by the largest diagonal entry divided by the
/// smallest pivot, because the largest eigenvalue is at least the largest diagonal entry, and the
/// smallest one at most the smallest pivot.
double factor_roundoff(const VariationalInequality& problem, const PenalisedCholesky& factor);

/// The effect of a constraint residual r2 on u. The unknowns are scaled by the square root of the
/// diagonal of A1 + B' M B, and then the rows of B by their norms. Rows whose distance is below
/// defaults::row_tolerance count as equal.
struct ConstraintDefect {
  /// max |v|, where v is the step that removes r2. Among all such steps it has the smallest norm in
  /// the scaled unknowns (a minimum-norm least squares step, G. H. Golub and C. F. Van Loan, Matrix
  /// Computations, 5.5). It estimates the error of u that r2 represents. Along a singular value s
  /// of B a residual of 1e-15 is an error of 1e-15 / s in u, and the next correction hardly changes
  /// it. A row of compliance c > 0 has an additional unknown with the coefficient sqrt(c / m),
  /// which regularises the least squares problem (Tikhonov).
  double displacement = 0;
  /// R: the part of the residual -r2 that no step removes. It is 0 in the rows of positive
  /// compliance. In the others -r2 is B u. It is the y of an infeasibility certificate (S. Boyd and
  /// L. Vandenberghe, Convex Optimization, 5.8): B' y = 0 where u is neither prescribed nor at an
  /// active bound.
  DoubleDoubleVector infeasible_part;
};

/// Computes the defect of constraint_residual (R) by a dense QR. `status`: C, from the solution.
/// Some problems are not examined, and both parts are then 0: where r2 is 0, where B has one row,
/// because it cannot depend on another row, where B has more than defaults::max_rows_for_qr rows,
/// and where the problem has more than 10 defaults::max_rows_for_qr unknowns. In the last two cases
/// Solution::error does not contain the error of nearly dependent rows. kernel_dimension
/// (analysis/) finds such rows.
ConstraintDefect constraint_defect(const VariationalInequality& problem,
                                   const Eigen::VectorXd& constraint_residual,
                                   const BoundStatuses& status);

/// Adds two errors of u to result.error, which is absolute here. Neither of them changes the size
/// of the corrections, so the estimate from the corrections does not contain them. The first one
/// comes from the forces B' M p, which are rounded even with 106 bits. It counts where p is large.
/// If this error is above 1e-9 U, result.warning is set and the second error is not computed. This
/// U is that of kkt.hpp, max(|u|, 1e-6 penalised_max_u), and not that of ForwardError. The second
/// one is the constraint defect of nearly dependent rows of B. If it is above 1e-9 U,
/// result.warning is set as well. Throws NotConverged where the defect proves that no u of this
/// size is admissible.
void add_conditioning_error(const VariationalInequality& problem, const PenalisedCholesky& factor,
                            const Eigen::VectorXd& constraint_residual, Solution& result);

}  // namespace antilock
