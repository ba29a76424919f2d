#pragma once
#include <algorithm>
#include <vector>

#include "antilock/solve/contact_problem.hpp"

namespace antilock {

/// The bounds of C values, and what can be asked of them without a matrix. `upper`: C entries, or empty for none.
struct ContactBounds {
  const Eigen::VectorXd& lower;
  const Eigen::VectorXd& upper;

  int count() const { return static_cast<int>(lower.size()); }
  double above(int i) const;  ///< the upper bound of i; infinite: none
  bool is_equation(int i) const { return lower(i) == above(i); }
  /// The bound at which `held` puts i.
  double at(const HeldBounds& held, int i) const;
  /// A start asks for bounds that there are, and an equation always holds.
  HeldBounds allowed(HeldBounds start) const;
  /// The nearest v within the bounds, and the bounds that hold there.
  Eigen::VectorXd nearest(const Eigen::VectorXd& v) const;
  HeldBounds reached(const Eigen::VectorXd& v) const;
  /// Puts i, at v and pushed by lambda, where its violated condition asks it to be. An unknown that is let go and would
  /// reach its other bound by itself, with this stiffness, goes there at once.
  void exchange(HeldBounds& held, int i, double v, double lambda, double stiffness) const;
};

/// Whether `held` puts i at its upper bound.
inline bool is_above(const HeldBounds& held, int i) { return !held.above.empty() && held.above[i]; }

/// Throws NotConverged: the contact loop has reached its most steps.
[[noreturn]] void throw_not_settled(int violations, int count, int steps);

/// The primal-dual active set, whatever solves its linear systems. A Road has
///     count()      conditions
///     solve()      the linear system of the bounds that hold now
///     violated(i)  whether condition i is on the wrong side by more than noise
///     exchange(i)  holds or lets go
///     descend()    the bounds that a projected Newton step proposes: it lowers the energy, so nothing can cycle
///     steps()      linear systems so far
/// Throws NotConverged after max_steps of them.
template <class Road>
void settle(Road& road, int max_steps) {
  int fewest = road.count() + 1;
  int patience = 5;  // exchanges of whole sets allowed without progress before the energy is asked
  while (true) {
    road.solve();
    std::vector<int> wrong;
    for (int i = 0; i < road.count(); ++i)
      if (road.violated(i)) wrong.push_back(i);
    const int violations = static_cast<int>(wrong.size());
    if (violations == 0) return;
    if (road.steps() >= max_steps) throw_not_settled(violations, road.count(), road.steps());
    patience = violations < fewest ? 5 : patience - 1;
    fewest = std::min(fewest, violations);
    if (patience > 0)
      for (const int i : wrong) road.exchange(i);
    else
      road.descend();
  }
}

}  // namespace antilock
