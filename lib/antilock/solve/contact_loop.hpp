#pragma once
#include <algorithm>
#include <vector>

#include "antilock/solve/contact_bounds.hpp"

namespace antilock {

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
