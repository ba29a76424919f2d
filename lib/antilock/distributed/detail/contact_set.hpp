#pragma once
#include <vector>

namespace antilock::distributed {

/// Which points of Gamma_C are in contact, all ranks' points by x: what one level tells the next, and what a checkpoint
/// holds. It does not depend on the number of ranks.
struct ContactSet {
  std::vector<double> x;     ///< ascending
  std::vector<char> active;  ///< as many

  int count() const;  ///< points in contact
  /// Whether a point between these is taken to be in contact: where its two neighbours are.
  bool at(double x) const;
};

/// The points of all ranks in one set, on every rank. `x` and `active` hold this rank's own points, in any order.
ContactSet gathered_set(const std::vector<double>& x, const std::vector<char>& active);

}  // namespace antilock::distributed
