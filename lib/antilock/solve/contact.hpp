#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "antilock/solve/bound_status.hpp"

namespace antilock {

/// The solution of K v = q + lambda for given statuses of the C bounds: each bound prescribes
/// either its value or its force. The other one of the two is a result and may lie outside its
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
/// SchurComplementContact has the bounded unknowns alone, n = C, because the others are condensed
/// out once. SparseContact has all free unknowns and factors K for every active set.
class ContactSystem {
 public:
  explicit ContactSystem(std::vector<int> bounded) : bounded_(std::move(bounded)) {}
  virtual ~ContactSystem() = default;
  /// Solves K v = q + lambda with v_i = prescribed_i where bound i is active and lambda_i =
  /// prescribed_i elsewhere. `active` and `prescribed` have C entries. Throws Error where K is not
  /// positive definite.
  virtual FixedStatusSolution solve(const std::vector<char>& active, const Eigen::VectorXd& prescribed) = 0;
  virtual double energy_norm_squared(const Eigen::VectorXd& d) const = 0;  ///< d' K d
  /// Returns C statuses to start from: those of the solution of a smaller problem of the same kind,
  /// transferred to all bounds (nested iteration). Throws as solve_contact does.
  virtual BoundStatuses nested_start(const Bounds& bounds, int max_iterations) = 0;
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
/// over all v with lower_i <= v_i <= upper_i at the hard bounds i; the sum is over the bounds with
/// a force limit g_i. Equivalently lambda = K v - q, and each pair (v_i, lambda_i) satisfies the
/// law of bound i (bound_status.hpp).
///
/// The method is an active set method with a projected search. The *face* of given statuses is the
/// set of all v with these statuses. On its affine hull J is a quadratic, and w denotes the
/// minimiser of this quadratic there. v starts at the first w, with each violated value moved to
/// its bound. Every iteration solves one linear system for w. Then
/// - w in the face: v = w, and each bound whose force is outside its range is released, that is,
///   takes the next status. Where there is none, v is the solution.
/// - else: v moves towards w, and each value that meets a bound on its way stays there, active.
///
/// The length of the step. Breakpoints are the fractions of the step at which values meet their
/// bounds. The full step is tried first, then the step up to the breakpoint at which half of the
/// violated values have stopped, then a quarter and so on, until J is lower than at the first
/// breakpoint. The last choice is the first breakpoint itself. The comparison is cheap, because
/// J(v) = J(w) + (v - w)' K (v - w) / 2 on the affine hull.
///
/// Claim. In exact arithmetic the iteration ends with the minimiser, whatever the start.
///
/// Assumptions. K is symmetric positive definite, and lower <= upper.
///
/// Proof.
///
/// (a) v is always in the closed face of its statuses. A value that is in its range at w stays in
/// it all the way to w, because ranges are intervals, and the others stop at their bounds.
///
/// (b) A step towards w never raises J. Up to the first breakpoint J does not rise, since w
/// minimises it on the affine hull, and a longer step is taken only where J is lower than at that
/// breakpoint.
///
/// (c) Such a step makes one bound or more active. So after at most C of them in a row w is in the
/// face.
///
/// (d) A release leaves v = w and J(v) as they are. Let lambda_i be the force of a released bound,
/// lambda_i' the force that its new status prescribes, w' the minimiser for the new statuses, and
/// d = w' - w. At the other unknowns where d is not 0, K w - q - lambda vanishes. Therefore
///
///     sum over the released i of (lambda_i - lambda_i') d_i = -d' K d < 0.
///
/// So one released value at least has (lambda_i - lambda_i') d_i < 0, that is, it leaves its bound
/// into the range of its new status.
///
/// (e) Steps of length 0 make the bounds active again whose values would leave in the wrong
/// direction. (d) holds for the bounds that remain released, so that one always remains, and there
/// are at most C such steps. Then v moves, and J falls strictly, because d is not 0.
///
/// (f) So J is strictly lower at every release than at the one before. Its value there depends on
/// the statuses alone, and there are finitely many of them. Therefore the iteration ends. At its
/// end all values and forces are in their ranges, and since J is strictly convex, these conditions
/// hold at its minimiser alone. End of the proof.
///
/// In floating-point arithmetic a force counts as outside its range beyond its round-off only.
/// Statuses that come back do so by round-off: their minimiser is returned, and the KKT report
/// (kkt.hpp) checks it. (The projection is that of D. P. Bertsekas, SIAM J. Control Optim. 20,
/// 1982; the release that of J. J. More and G. Toraldo, SIAM J. Optim. 1, 1991.)
///
/// `start` has C statuses; without it the iteration starts from ContactSystem::nested_start. Throws
/// NotConverged after max_iterations linear systems, and Error where K is not positive definite.
ContactResult solve_contact(ContactSystem& system, const Bounds& bounds, const std::optional<BoundStatuses>& start,
                            int max_iterations);

/// Returns C statuses to start from. `coarse` is the same problem with every second bound alone (1,
/// 3, 5, ...), and its solution gives the statuses of these. Each of the other bounds has the
/// status of its two neighbours in the order of the bounds where they agree, and is inactive where
/// they do not. Throws as solve_contact does.
BoundStatuses coarse_start(const Bounds& bounds, ContactSystem& coarse, int max_iterations);

}  // namespace antilock
