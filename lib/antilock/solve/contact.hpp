#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "antilock/solve/bound_status.hpp"

namespace antilock {

/// The solution of K v = q + lambda in which each bound prescribes either v or lambda.
struct FixedStatusSolution {
  Eigen::VectorXd v;       ///< n, all unknowns of the system
  Eigen::VectorXd lambda;  ///< C
  /// C: the round-off of each force, defaults::round_off times the sum of the absolute terms of its row.
  Eigen::VectorXd round_off;
};

/// The linear system of a contact problem, K symmetric positive definite (n x n), C of its unknowns bounded: all others
/// are eliminated from it, once (SchurComplementContact: n = C) or with every set (SparseContact).
class ContactSystem {
 public:
  explicit ContactSystem(std::vector<int> bounded) : bounded_(std::move(bounded)) {}
  virtual ~ContactSystem() = default;
  /// Solves with v_i = prescribed_i where bound i is active, and lambda_i = prescribed_i elsewhere; lambda counts
  /// from Bounds::multiplier_estimate. Throws Error where K is not positive definite.
  virtual FixedStatusSolution solve(const std::vector<char>& active, const Eigen::VectorXd& prescribed) = 0;
  virtual double energy_norm_squared(const Eigen::VectorXd& d) const = 0;  ///< d' K d, the squared energy norm
  /// A start near the solution: the statuses of a smaller problem of the same kind (nested iteration).
  virtual BoundStatuses nested_start(const Bounds& bounds, int max_iterations) = 0;
  const std::vector<int>& bounded() const { return bounded_; }  ///< C: bound -> unknown

 private:
  std::vector<int> bounded_;
};

struct ContactResult {
  Eigen::VectorXd v, lambda;  ///< n; C, with the accumulated forces
  BoundStatuses status;       ///< C
  int steps = 0;              ///< linear systems solved
};

/// Finds the v that minimises J(v) = v' K v / 2 - q' v plus the work against the force limits: lambda = K v - q, and
/// each pair (v_i, lambda_i) satisfies the law of bound i (bound_status.hpp). The method is an active set method with a
/// projected search. A *face* is the set of all v with the same statuses. v starts at w, with each violated value
/// moved to its bound. Each step is:
///
///     solve with the statuses as they are: w, the minimiser of J on the face (of its affine hull)
///     w is feasible:  v = w.  Bounds whose forces are outside their ranges are released; if there is none, v solves
///     w is not:       v moves towards w.  A value that meets a bound on the way stays there, and becomes active
///
/// The length of the step. While the statuses stay, J(v) = J(w) + (v - w)' K (v - w) / 2. Up to the first breakpoint
/// (the first value that meets a bound) J falls in any case. On the full step, with every violated value stopped at
/// its bound, J may rise. So the full step is tried first, then the step on which the first half of the violated
/// values stop, then a quarter, ..., at last the first alone, until J is lower than at the first breakpoint.
///
/// Why it ends. A step towards w makes one bound more active at least and never raises J, so that after at most C of
/// them v = w. Releasing lowers J there: the slope of J towards the new w is negative, since w is lower. This slope is
/// the sum, over the released bounds, of force times direction. So one of them at least moves off its bound, and J
/// falls strictly. So no minimiser of a face is met twice, and there are finitely many faces. A face that is met again
/// is met by round-off: its minimiser is returned, and the KKT report checks it. (The projection is that of D. P.
/// Bertsekas, SIAM J. Control Optim. 20, 1982; the release that of J. J. More and G. Toraldo, SIAM J. Optim. 1, 1991.)
///
/// Without a start it begins at the nested one. Throws NotConverged after max_steps linear systems.
ContactResult solve_contact(ContactSystem& system, const Bounds& bounds, const std::optional<BoundStatuses>& start,
                            int max_iterations);

/// A start from the solution of `coarse`, the same problem bounded at every second bound only (1, 3, 5, ...): each of
/// the others has the status of its two neighbours in the order of the bounds where they agree, and is inactive else.
BoundStatuses coarse_start(const Bounds& bounds, ContactSystem& coarse, int max_iterations);

}  // namespace antilock
