#pragma once
#include <optional>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {

/// Solves problems with one pair (A1, B) and with several compliances, loads or bounds. Work on the
/// constant parts is done once:
/// - The forms a1 and a0 do not contain the compliance. So they are assembled once, before the
///   sweep.
/// - All loads, all bounds and all compliances that lead to the same penalty delta share one
///   factorisation.
/// - Each solve starts from the contact set of the solve before.
///
/// The problem may be any one of the class. SceneSweep does the same for a scene.
class Sweep {
 public:
  /// Throws Error as `check` does.
  explicit Sweep(VariationalInequality problem);

  /// Sets the class parameter, 0 to 1. Throws Error if nothing is stiff (B has no rows).
  void set_compliance(double compliance);
  /// Sets the load, N entries, one per unknown. Throws Error for another size, and for entries that
  /// are not finite.
  void set_load(Eigen::VectorXd load);
  /// Sets the bounds, C entries each as in the problem. Without `upper` the upper bounds stay.
  /// Throws Error if no unknown is bounded, and as check_bounds does.
  void set_bounds(Eigen::VectorXd lower, std::optional<Eigen::VectorXd> upper = {});
  /// Sets the force limits, C entries as in the problem. Throws Error as check_bounds does.
  void set_force_limit(Eigen::VectorXd force_limit);

  /// Returns the solution. Its counters contain the operations of this solve only. Every solve uses
  /// the ContactReduction of the first one.
  Solution solve(ActiveSetOptions options = {});

  const VariationalInequality& problem() const { return problem_; }
  const Counters& total() const { return total_; }  ///< of all solves so far
  /// Returns the factor of the last solve, with its delta. Throws Error before the first solve.
  const PenalisedCholesky& factor() const;

 protected:
  VariationalInequality problem_;

 private:
  std::optional<PenalisedCholesky> factor_;
  double asked_ = 0;  ///< the delta that the last solve requested
  std::optional<BoundStatuses> status_;
  Counters total_;
};

}  // namespace antilock
