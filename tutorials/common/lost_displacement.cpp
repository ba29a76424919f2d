#include "common/lost_displacement.hpp"

#include <fmt/format.h>

#include <cmath>

namespace antilock::tutorial {

Table lost_to_kept(const Table& locked, const Table& usual) {
  const double smallest = locked.least("epsilon");
  const auto l2 = [](const Table& table, const Entry& epsilon) { return table.where("epsilon", epsilon).number("l2"); };
  const auto excess = [&](const Entry& epsilon) {
    return std::sqrt(std::max(0.0, std::pow(l2(locked, epsilon), 2) - std::pow(l2(usual, epsilon), 2)));
  };
  Table table({"curve", "inverse_epsilon", "x"});
  for (const Entry& epsilon : locked.different("epsilon")) {
    const double share = excess(epsilon) / excess(smallest);
    if (l2(locked, epsilon) > 2 * l2(usual, epsilon) && share > 0.03 && share < 0.97)
      table.add({fmt::format("$h = 1/{}$", locked.first("cells")), 1 / epsilon.number(), share / (1 - share)});
  }
  return table;
}

double half_lost(const Table& lost) {
  const std::vector<double> inverse = lost.numbers("inverse_epsilon"), x = lost.numbers("x");
  std::size_t i = 0;
  while (i + 2 < x.size() && x[i + 1] < 1) ++i;
  const double s = std::log(1 / x[i]) / std::log(x[i + 1] / x[i]);
  return 1 / (inverse[i] * std::pow(inverse[i + 1] / inverse[i], s));
}

Table walls(const Table& p1, const Table& cr, Table& lost) {
  Table rows({"cells", "h", "a", "half lost at epsilon"});
  for (const Entry& cells : p1.different("cells")) {
    const Table own = lost_to_kept(p1.where("cells", cells), cr.where("cells", cells));
    lost.add(own);
    rows.add({cells, 1 / cells.number(), own.order("x", "inverse_epsilon"), half_lost(own)});
  }
  return rows;
}

}  // namespace antilock::tutorial
