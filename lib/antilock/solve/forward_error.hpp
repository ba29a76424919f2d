#pragma once
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/residual.hpp"

namespace antilock {

/// The estimated forward error of an iterate u, the distance from the exact solution of the
/// discrete problem. The residuals r1 and r2 of a correction are exact, so that the error of u is
/// the sum of the corrections to come. With `next` an estimate of the next correction and `rate`
/// the measured contraction, that is next / (1 - rate). LAPACK's xGERFSX estimates the errors of
/// its solutions in the same way.
struct ForwardError {
  /// next / (1 - rate) over U = max(|u|, eps largest / tolerance) in the maximum norm; largest =
  /// max(|u|, largest_u).
  double relative = 1;
  double constraint = 1;  ///< the largest |r2_j| over the tolerance of row j, see forward_error()
  double absolute = 0;    ///< next / (1 - rate), plus the largest |r2_j| / sum_k |B_jk|
  /// Returns whether the iteration may stop.
  bool within(double tolerance) const { return relative <= tolerance && constraint <= 1; }
};

/// Estimates the forward error of u (N) after a correction. next_correction estimates the next
/// correction of u and contraction is the rate, both in the maximum norm; largest_u is
/// Solution::penalised_max_u. constraint_residual (R) is r2 = compliance p - B u, which after a
/// correction is (compliance - delta) dp exactly. Row j counts as satisfied where
///
///     |r2_j| <= t U sum_k |B_jk|
///     t = max(defaults::row_tolerance max(1, tolerance / 1e-10), contact_tolerance)
///
/// and constraint_defect() below estimates the error of u that such a residual may hide. Where the
/// problem may be infeasible, |r2_j| must also be at most CorrectionOptions::kkt_fail() times sum_k
/// |B_jk u_k|, and times the largest bound or prescribed value times sum_k |B_jk|. Otherwise a
/// large u would hide a constraint that is never met.
ForwardError forward_error(const VariationalInequality& problem, const DoubleDoubleVector& u, double next_correction,
                           const Eigen::VectorXd& constraint_residual, double contraction, double largest_u,
                           const CorrectionOptions& options);

/// Throws NotConverged where y (R) proves by Farkas's lemma (forward_error.cpp) that no admissible
/// u has max |u| <= max_u. y is a residual of B u = 0 that does not decay, and u (N) is the iterate
/// that left it. There are two calls. While the corrections are slow, y = M B u, and u may still
/// grow: max_u is then 1 / sqrt(eps) times the largest |u| so far, half the digits of a double.
/// That should be ample, since a stiffer problem hardly moves more than the penalised one
/// (expected, not proved). For a solution, y is ConstraintDefect::infeasible_part and max_u is
/// slightly above the largest |u|.
void throw_if_infeasible(const VariationalInequality& problem, const DoubleDoubleVector& y, const Eigen::VectorXd& u,
                         double max_u, const Solution& so_far);

/// Estimates the round-off of one solve relative to u where B has no rows, so that K is A1: n_free
/// eps cond(K). cond(K) is estimated from below by the largest diagonal entry over the smallest
/// pivot, because the largest eigenvalue is at least the one and the smallest eigenvalue at most
/// the other.
double factor_roundoff(const VariationalInequality& problem, const PenalisedCholesky& factor);

/// The effect of a constraint residual r2 on u. Unknowns are scaled by the square root of the
/// diagonal of A1 + B' M B, then rows by their norms. Rows whose distance is below
/// defaults::row_tolerance count as equal.
struct ConstraintDefect {
  /// max |v|, where v is the shortest step, in the norm of that diagonal, which removes r2. It
  /// estimates the error of u that r2 represents: along a singular value s of B a residual of 1e-15
  /// is an error of 1e-15 / s in u, and the next correction hardly changes it. A row of compliance
  /// c > 0 is relaxed by c: its term c / m regularises the least squares problem as Tikhonov's
  /// does.
  double displacement = 0;
  /// R: the part of r2 in the rows of compliance 0 that no step removes. It is the y of an
  /// infeasibility certificate (S. Boyd and L. Vandenberghe, Convex Optimization, 5.8): B' y = 0
  /// where u is neither prescribed nor at an active bound.
  DoubleDoubleVector infeasible_part;
};

/// Computes the defect of constraint_residual (R) by a dense QR. `status`: C, from the solution.
/// Where B has more than defaults::max_rows_for_qr rows, or the problem more than ten times as many
/// unknowns, both parts are 0 without a computation. Then Solution::error does not contain the
/// error of nearly dependent rows; kernel_dimension (analysis/) finds such rows.
ConstraintDefect constraint_defect(const VariationalInequality& problem, const Eigen::VectorXd& constraint_residual,
                                   const BoundStatuses& status);

/// Adds to result.error, which is absolute here, the errors of u that no correction shows: the
/// round-off of forces p that are too large for 106 bits, and the constraint defect of nearly
/// dependent rows of B. Sets result.warning where one of them is above 1e-9 of u, the forces first.
/// Throws NotConverged where the defect proves that no u of this size is admissible.
void add_conditioning_error(const VariationalInequality& problem, const PenalisedCholesky& factor,
                            const Eigen::VectorXd& constraint_residual, Solution& result);

}  // namespace antilock
