#pragma once
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/residual.hpp"

namespace antilock {

/// The estimated forward error of an iterate, from the correction that led to it. The residuals r1 and r2 were exact,
/// so that the error of u is the sum of the corrections to come, next + rate next + rate^2 next + ..., as LAPACK's
/// xGERFSX estimates that of its solutions.
struct ForwardError {
  double relative = 1;    ///< of u: next / (1 - rate) over U = max(|u|, eps |largest u| / tolerance)
  double constraint = 1;  ///< the largest constraint residual |r2_j| of a row of B u = compliance p over its tolerance
  double absolute = 0;    ///< of u: next / (1 - rate), plus |r2_j| / (|B| 1)_j of the worst row
  bool within(double tolerance) const { return relative <= tolerance && constraint <= 1; }
};

/// Estimates the forward error of u. After a correction the constraint residual r2 is (compliance - delta) dp, exactly.
/// A row j satisfies its constraint where
///
///     |r2_j| <= defaults::row_tolerance (|B| 1)_j U
///
/// constraint_defect() below says how much of u such a residual may stand for. The factor row_tolerance grows with a
/// tolerance that is larger than the default, and with that of the contact solver. Where the problem may be infeasible,
/// |r2_j| must also be at most CorrectionOptions::kkt_fail() times the terms of the row, and times the largest bound and
/// prescribed value: otherwise a large u would hide a row whose constraint is never met.
ForwardError forward_error(const VariationalInequality& problem, const DoubleDoubleVector& u, double next_correction,
                           const Eigen::VectorXd& constraint_residual, double contraction, double largest_u,
                           const CorrectionOptions& options);

/// Throws NotConverged where y (R), a residual of B u = 0 that does not go away, proves by Farkas's lemma
/// (forward_error.cpp) that no admissible u has max |u| <= `max_u`; u (N) is the iterate that left it. There are two
/// calls. While the corrections are slow, y = M B u, and u may still grow: `max_u` is then 1 / sqrt(eps) times the
/// largest u so far, half of a double's digits. That is ample, since a stiffer problem hardly moves more than the
/// penalised one (expected, not proved). For a solution, y is ConstraintDefect::infeasible_part, and `max_u` is the
/// size of u.
void throw_if_infeasible(const VariationalInequality& problem, const DoubleDoubleVector& y, const Eigen::VectorXd& u,
                         double max_u, const Solution& so_far);

/// The round-off of one solve relative to u, n_free eps cond(K), where B has no rows: K is then A1. cond(K) is
/// estimated by the largest diagonal entry over the smallest pivot: neither is farther out than its eigenvalue, so that
/// the estimate is a lower one, and the factor n_free is a heuristic.
double factor_roundoff(const VariationalInequality& problem, const PenalisedCholesky& factor);

/// The effect of a constraint residual r2. Each row counts in its own unit, each unknown in that of its stiffness; rows
/// whose distance is below defaults::row_tolerance count as equal.
struct ConstraintDefect {
  /// The error of u that r2 stands for: max |v|, v the shortest step (in the energy of the diagonals) that meets the
  /// constraints. Along a singular value s of B a residual of 1e-15 stands for 1e-15 / s of u, and the next correction
  /// hardly changes it. A row of compliance c > 0 takes a part of the step itself, as a spring of stiffness m / c.
  double displacement = 0;
  /// R: the part of r2 that no step removes in the rows of compliance 0, as the y of an infeasibility certificate
  /// (Boyd and Vandenberghe, Convex Optimization, 5.8): B' y = 0 where u is neither prescribed nor at an active bound.
  DoubleDoubleVector infeasible_part;
};

/// Computed by a dense QR. Where B has more than defaults::max_rows_for_qr rows, or more than ten times as many
/// unknowns, both parts are 0 without a computation: Solution::error does not contain such rows there, and
/// kernel_dimension (analysis/) finds them.
ConstraintDefect constraint_defect(const VariationalInequality& problem, const Eigen::VectorXd& constraint_residual,
                                   const BoundStatuses& status);

/// Adds to result.error, which is absolute here, the errors of u that no correction shows: the round-off of forces p
/// that are so large that 106 bits do not hold them, and the constraint defect of nearly dependent rows of B. Warns
/// where one of them is above 1e-9 of u, of the forces first. Throws NotConverged where the defect proves that no u of
/// this size is admissible.
void add_conditioning_error(const VariationalInequality& problem, const PenalisedCholesky& factor,
                            const Eigen::VectorXd& constraint_residual, Solution& result);

}  // namespace antilock
