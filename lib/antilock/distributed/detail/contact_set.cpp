#include "antilock/distributed/detail/contact_set.hpp"

#include <algorithm>
#include <numeric>

#include "antilock/distributed/ranks.hpp"

namespace antilock::distributed {

int ContactSet::count() const { return static_cast<int>(std::count(active.begin(), active.end(), 1)); }

bool ContactSet::at(double where) const {
  constexpr double slack = 1e-9;  // a point that both meshes have stands between itself and itself
  const auto right = std::lower_bound(x.begin(), x.end(), where - slack);
  const auto left = std::upper_bound(x.begin(), x.end(), where + slack);
  const bool from_right = right != x.end() && active[right - x.begin()] != 0;
  const bool from_left = left != x.begin() && active[left - x.begin() - 1] != 0;
  if (right == x.end()) return from_left;
  if (left == x.begin()) return from_right;
  return from_left && from_right;
}

ContactSet gathered_set(const std::vector<double>& x, const std::vector<char>& active) {
  const std::vector<double> all_x = gathered(x), all_active = gathered({active.begin(), active.end()});
  std::vector<std::size_t> order(all_x.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return all_x[i] < all_x[j]; });
  ContactSet set;
  for (const std::size_t i : order) {
    set.x.push_back(all_x[i]);
    set.active.push_back(all_active[i] != 0 ? 1 : 0);
  }
  return set;
}

}  // namespace antilock::distributed
