#pragma once
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/residual.hpp"

namespace antilock {

/// How far an iterate is from the answer, judged by the correction that led to it: r1 and r2 were exact, so the next
/// corrections, `next_correction` + rate next + rate^2 next + ..., are what u is wrong by (LAPACK's xGERFSX asks the
/// same of its solutions).
struct ForwardError {
  double relative = 1;    ///< of u: next / (1 - rate), relative to U = max(|u|, eps |largest u| / tolerance)
  double constraint = 1;  ///< of the rows of B u = compliance p, the worst: |r2_j| over what it may be
  double absolute =
      0;  ///< of u, absolute: next / (1 - rate), and what closes the worst row at least, |r2_j| / (|B| 1)_j
  bool within(double tolerance) const { return relative <= tolerance && constraint <= 1; }
};

/// What is left of r2 after a correction is (compliance - delta) dp, exactly. A row is closed at
///     |r2_j| <= defaults::row_tolerance (|B| 1)_j U
/// and what that may leave of u is told by constraint_defect below. The factor defaults::row_tolerance is larger where
/// the tolerance asked for is larger than the default, and where the contact solver works to a tolerance. Where there
/// may be no answer at all, |r2_j| must also be below `refused` times the row's own terms, and times the largest bound
/// and prescribed value: else a great u would hide a row that never closes.
ForwardError forward_error(const VariationalInequality& problem, const DoubleDoubleVector& u, double next_correction,
                           const Eigen::VectorXd& constraint_residual, double contraction, double largest_u,
                           const CorrectionOptions& options);

/// Throws NotConverged where y (R), a residual of B u = 0 that does not go away, proves by Farkas's certificate
/// (forward_error.cpp) that no u of at most `within` is admissible, u (N) being the one that left it. It is asked
/// twice. While the corrections are slow, y = M B u, and u may still grow. `within` is 1 / sqrt(eps) times the largest
/// u so far then, half of a double's digits: ample, since a stiffer problem hardly moves more than the moderate one
/// (expected, not proved). Of an answer y is ConstraintDefect::for_good, and `within` is its own size.
void throw_if_infeasible(const VariationalInequality& problem, const DoubleDoubleVector& y, const Eigen::VectorXd& u,
                         double within, const Solution& so_far);

/// F eps cond(K): what a solve may be wrong by, relative to u. Without B, where it is asked for, K is A1. The largest of
/// its diagonal over the smallest pivot stands for cond(K): an estimate, no bound.
double factor_roundoff(const VariationalInequality& problem, const PenaltyFactor& factor);

/// What is left of r2, and what it does. Each row in its own unit, each unknown in that of its stiffness; rows nearer
/// to dependent than defaults::row_tolerance are one.
struct ConstraintDefect {
  /// By how much u is off for it: max |v|, v the shortest step (in the energy of the diagonals) that closes the rows.
  /// Along a singular value s of B an r2 of 1e-15 stands for 1e-15 / s of u, and the next correction hardly moves that.
  /// A row of compliance c gives way as well: a spring of its own, of the stiffness m / c, takes a part of the step.
  double displacement = 0;
  /// R: the part of r2 that no step closes in the rows of compliance 0, as the y of a certificate: B' y = 0 where u is
  /// neither prescribed nor held.
  DoubleDoubleVector infeasible_part;
};
/// A dense QR: where B has more than defaults::max_rows_for_qr rows, or there are more than ten times as many
/// unknowns, nothing is looked for and both are 0. There Solution::error knows nothing of such rows, and
/// `kernel_dimension` (analysis/) tells.
ConstraintDefect constraint_defect(const VariationalInequality& problem, const Eigen::VectorXd& constraint_residual,
                                   const BoundStatuses& status);

/// What no correction shows: forces of p so large that 106 bits leave something of them, and rows of B so nearly
/// dependent that what is left of them moves u. Adds what u moves by to the error of `answer`, absolute yet, and warns
/// where it is above 1e-9 of u: of the forces first. Throws NotConverged where what is left of r2 proves that no u of
/// this size is admissible.
void add_conditioning_error(const VariationalInequality& problem, const PenaltyFactor& factor,
                            const Eigen::VectorXd& constraint_residual, Solution& result);

}  // namespace antilock
