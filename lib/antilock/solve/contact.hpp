#pragma once
#include <optional>
#include <utility>
#include <vector>

#include "antilock/solve/bounds.hpp"

namespace antilock {

/// The equilibrium K v = q + lambda in which one of value and force is given per bound.
struct Equilibrium {
  Eigen::VectorXd v;       ///< n, all unknowns of the system
  Eigen::VectorXd lambda;  ///< C
  Eigen::VectorXd
      round_off;  ///< C: of a force there, defaults::round_off times the sum of the absolute terms of its row
};

/// The linear system of a contact problem, K symmetric positive definite (n x n), C of its unknowns bounded: all others
/// are eliminated from it, once (DenseContact: n = C) or with every set (SparseContact).
class ContactSystem {
 public:
  explicit ContactSystem(std::vector<int> bounded) : bounded_(std::move(bounded)) {}
  virtual ~ContactSystem() = default;
  /// v_i = given_i where bound i is held, lambda_i = given_i elsewhere; lambda counts from Stairs::force. Throws Error
  /// where K is not positive definite.
  virtual Equilibrium solve(const std::vector<char>& active, const Eigen::VectorXd& prescribed) = 0;
  virtual double square(const Eigen::VectorXd& d) const = 0;  ///< d' K d
  /// A start near the answer: that of a smaller problem of the same kind.
  virtual BoundStatuses nested_start(const Bounds& bounds, int max_steps) = 0;
  const std::vector<int>& bounded() const { return bounded_; }  ///< C: bound -> unknown

 private:
  std::vector<int> bounded_;
};

struct ContactResult {
  Eigen::VectorXd v, lambda;  ///< n; C, the whole force
  BoundStatuses status;       ///< C
  int steps = 0;              ///< linear systems solved
};

/// Finds the v that minimises J = v' K v / 2 - q' v and the work of the bounds that give way, on its stairs: lambda =
/// K v - q, and (v_i, lambda_i) on stair i. A descent: v starts at w, with what lies beyond a piece put to its end.
///
///     solve with the pieces as they are: w, the lowest point of J while these hold
///     where w leaves no piece, v = w:  a bound whose force leaves its piece is let go; none is: v is the answer
///     else v goes towards w:  a value whose piece ends on the way stays at that end, and is held from now on
///
/// How far? While the pieces stay, J(v) = J(w) + (v - w)' K (v - w) / 2. To the first end it falls in any case; all the
/// way, with every value that leaves its piece stopped, it may rise. So the whole way is tried, then the way on which
/// the first half of them stops, a quarter, ... the first alone, until J is lower than where the first one stops.
///
/// It ends: a step on the way holds one bound more at least and never raises J, so after at most C of them v = w.
/// Letting go lowers J there: its slope towards the new w is negative, as w is lower. This slope is the sum over the
/// bounds let go of force times way, so that one of them at least moves off its end, and J falls strictly. So no lowest
/// point is met twice, and they are finitely many. One that is met again is a tie by round-off: it is taken, and the KKT
/// report judges it. (D. P. Bertsekas, SIAM J. Control Optim. 20, 1982, projects like this; J. J. More and G. Toraldo,
/// SIAM J. Optim. 1, 1991, let go like this.)
///
/// Without a start it begins at the nested one. Throws NotConverged after max_steps linear systems.
ContactResult solve_contact(ContactSystem& system, const Bounds& bounds, const std::optional<BoundStatuses>& start,
                            int max_steps);

/// A start from the answer of `coarse`, the same problem bounded at every second bound only (1, 3, 5, ...): each of the
/// others is on the piece of its two neighbours in the order of the bounds, where they agree.
BoundStatuses coarse_start(const Bounds& bounds, ContactSystem& coarse, int max_steps);

}  // namespace antilock
