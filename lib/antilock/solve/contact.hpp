#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "antilock/solve/bound_status.hpp"

namespace antilock {

/// The solution of K v = q + lambda for given statuses of the C bounds: each bound prescribes
/// either its value or its force. The other one of the two is computed, and may lie outside of its
/// admissible range.
struct FixedStatusSolution {
  Eigen::VectorXd v;       ///< n, all unknowns of the system
  Eigen::VectorXd lambda;  ///< C
  /// C: an estimate of the round-off in each force, defaults::round_off times the sum of the
  /// absolute values of the terms of its row of K v - q.
  Eigen::VectorXd round_off;
};

/// The linear system K v = q + lambda of a contact problem. K (n x n) is symmetric positive
/// definite, C of its unknowns are bounded, and lambda acts on these. There are two kinds:
/// SchurComplementContact has only the bounded unknowns, n = C, because the others are condensed
/// out once. SparseContact has all free unknowns, and factors K for every active set.
class ContactSystem {
 public:
  explicit ContactSystem(std::vector<int> bounded) : bounded_(std::move(bounded)) {}
  virtual ~ContactSystem() = default;
  /// Solves K v = q + lambda with v_i = prescribed_i where bound i is active and lambda_i =
  /// prescribed_i elsewhere. `active` and `prescribed` have C entries. Throws Error where K is not
  /// positive definite.
  virtual FixedStatusSolution solve(const std::vector<char>& active,
                                    const Eigen::VectorXd& prescribed) = 0;
  virtual double energy_norm_squared(const Eigen::VectorXd& d) const = 0;  ///< d' K d
  /// Returns C statuses to start from: those of the solution of a smaller problem of the same kind,
  /// transferred to all bounds (nested iteration). Throws as solve_contact does.
  virtual BoundStatuses nested_start(const ShiftedBounds& bounds, int max_iterations) = 0;
  const std::vector<int>& bounded() const { return bounded_; }  ///< C: bound -> unknown

 private:
  std::vector<int> bounded_;
};

struct ContactResult {
  Eigen::VectorXd v, lambda;  ///< n; C, the multiplier estimate included
  BoundStatuses status;       ///< C
  int steps = 0;              ///< iterations, one linear system each
};

/// Solves a contact problem: finds the v that minimises
///
///     J(v) = v' K v / 2 - q' v + sum_i g_i dist(v_i, [lower_i, upper_i])
///
/// over all v with lower_i <= v_i <= upper_i at the hard bounds i. The sum is over the bounds with
/// a force limit g_i. Equivalently lambda = K v - q, and each pair (v_i, lambda_i) satisfies the
/// law of bound i (bound_status.hpp). The q of these formulas is the q of the system minus the
/// multiplier estimate of `bounds`, and lambda is the total force.
///
/// The method is an active set method with a projected search. A status prescribes either the value
/// or the force of its bound. The *face* of given statuses is the set of all v with v_i at its
/// bound where status i is active, and in the range of status i elsewhere. On the face J is equal
/// to
///
///     Q(v) = v' K v / 2 - q' v + sum of g_i (lower_i - v_i) over the bounds i that slip below
///                              + sum of g_i (v_i - upper_i) over the bounds i that slip above.
///
/// The affine hull of the face consists of all v whose active values are at their bounds. At its
/// points outside of the face J is at least Q. Let w be the minimiser of the quadratic Q on the
/// affine hull. It solves the linear system of FixedStatusSolution, because this system is the
/// optimality condition of Q.
///
/// v starts at the first w. Each value that is outside of its range is moved to the end of this
/// range, and its bound becomes active. Every iteration solves one linear system for w. Then
/// - If w is in the face, v is set to w. Each bound whose force is outside of its range is
///   released: it takes the next status. If there is no such bound, v is the solution.
/// - Otherwise v moves towards w. Each value that meets the end of its range on the way stays
///   there, and its bound becomes active.
///
/// The length of the step. Breakpoints are the fractions of the step at which values meet the ends
/// of their ranges. The full step is tried first. If J is not lower there than at the first
/// breakpoint, shorter steps are tried until J is lower: up to the breakpoint at which half of the
/// values with a breakpoint have stopped, then a quarter of them, and so on. The last choice is the
/// first breakpoint itself. The comparison is cheap, because all these points are in the face, and
/// J(v) = Q(v) = Q(w) + (v - w)' K (v - w) / 2 there.
///
/// Claim. In exact arithmetic the iteration ends with the minimiser, whatever the start.
///
/// Assumptions. K is symmetric positive definite, and lower <= upper.
///
/// Proof.
///
/// (a) v is always in the face of its statuses. On the way to w, a value that is in its range at w
/// stays in this range, because ranges are intervals. Every other value stops at the end of its
/// range, which is the value that its next, active status prescribes. A released value is at the
/// end of the range of its new status.
///
/// (b) A step towards w never raises J. Up to the first breakpoint v stays in the face, where J is
/// equal to Q. Q does not rise, because w minimises it on the affine hull. A longer step is taken
/// only where J is lower than at that breakpoint.
///
/// (c) Such a step makes at least one bound active, and releases none. So after at most C of them
/// in a row w is in the face.
///
/// (d) A release leaves v = w and J(v) as they are. Let i be a released bound. Its force lambda_i
/// at w is outside of its range, and its new status prescribes the force lambda_i' at the end of
/// this range. So lambda_i' is not lambda_i. Let w' be the minimiser for the new statuses, lambda'
/// its forces, and d = w' - w. Then K d = lambda' - lambda. At a bound that is not released, either
/// both statuses prescribe the value, and d_i = 0, or both prescribe the same force. An unknown
/// without a bound has no force. Therefore
///
///     sum over the released i of (lambda_i - lambda_i') d_i = -d' K d < 0,
///
/// and d is not 0, because lambda' - lambda is not. So the term of at least one released bound is
/// negative. The value of this bound grows if its force was too small, and falls if its force was
/// too large: it leaves the bound into the range of its new status.
///
/// (e) Between two releases J falls strictly. First let w' be in the face. Then v is set to w', and
/// J falls by d' K d / 2. Otherwise v moves towards w'. If the first breakpoint is not v itself, J
/// falls strictly, because w' is the only minimiser of Q and is not v. If the first breakpoint is v
/// itself, some values are already at the end of their ranges, and the corresponding values of w'
/// are outside of these ranges. A step of positive length is taken only if J falls strictly.
/// Otherwise the step has the length 0: the bounds of these values become active, and v and J stay.
/// Some of these bounds may be released ones. But a bound with a negative term in (d) is not among
/// them, because its value moves into its range. So at least one bound is still released. (d) holds
/// again for the next w' and for the bounds that are still released, because d_i is 0 at each bound
/// that has become active. Each step of length 0 makes a bound active, so there are at most C of
/// them, and then J falls strictly.
///
/// (f) So J is strictly lower at every release than at the one before. At a release v = w, and J(w)
/// depends on the statuses alone. There are finitely many statuses. Therefore the iteration ends.
/// At its end all values and forces are in their ranges. Since J is strictly convex, only its
/// minimiser satisfies these conditions. End of the proof.
///
/// In floating-point arithmetic a force counts as outside of its range only if it is outside by
/// more than its round-off. Values have no such tolerance. If the same statuses occur at two
/// releases, round-off is the reason. The iteration then returns their minimiser, and the KKT
/// report (kkt.hpp) checks it. (The projection is that of D. P. Bertsekas, SIAM J. Control Optim.
/// 20, 1982. The release is that of J. J. More and G. Toraldo, SIAM J. Optim. 1, 1991.)
///
/// `start` has C statuses. A status that its bound cannot have is replaced
/// (ShiftedBounds::nearest_valid). Without `start` the iteration starts from
/// ContactSystem::nested_start. Throws NotConverged after max_iterations linear systems, and Error
/// where K is not positive definite.
ContactResult solve_contact(ContactSystem& system, const ShiftedBounds& bounds,
                            const std::optional<BoundStatuses>& start, int max_iterations);

/// Returns C statuses to start from. `coarse` is the same problem with only every second bound (1,
/// 3, 5, ...), and its solution gives the statuses of these bounds. Each bound of `coarse` has its
/// own force limit and half of that of each of its two neighbours, which are left out. Each of the
/// other bounds takes the status of its two neighbours in the order of the bounds if they agree,
/// and is inactive otherwise. Throws as solve_contact does.
BoundStatuses coarse_start(const ShiftedBounds& bounds, ContactSystem& coarse, int max_iterations);

}  // namespace antilock
