#pragma once
#include <algorithm>
#include <cmath>
#include <string>

#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// Orders as the course defines them: on each mesh the supremum over a parameter comes first, then the order in h from one
/// mesh to the next.
struct Supremum {
  Table rows;              ///< one row per h: h, "worst", "at" (the parameter there), "order" (from the h before)
  double low, high, last;  ///< the smallest and the largest of these orders, and that between the two finest meshes
  double denser;           ///< the largest growth of a supremum, as a factor, by every second value of the parameter
};

/// `runs` holds, for one method, a row per h and value of the parameter, meshes from coarse to fine, the values in order.
inline Supremum supremum(const Table& runs, const std::string& value, const std::string& parameter) {
  Supremum found{Table({"h", "worst", "at", "order"}), 1e300, -1e300, 0, 1};
  double h_before = 0, before = 0;
  for (const Entry& h : runs.different("h")) {
    const Table mesh = runs.where("h", h);
    double worst = 0, half = 0, at = 0;
    for (int i = 0; const Table& row : mesh.rows()) {
      const double here = row.number(value);
      if (here > worst) worst = here, at = row.number(parameter);
      if (i++ % 2 == 0) half = std::max(half, here);
    }
    const double order = std::log(before / worst) / std::log(h_before / h.number());
    found.rows.add({h, worst, at, h_before > 0 ? Entry(order) : Entry("")});
    if (h_before > 0)
      found.low = std::min(found.low, order), found.high = std::max(found.high, order), found.last = order;
    found.denser = std::max(found.denser, worst / half);
    h_before = h.number(), before = worst;
  }
  return found;
}

}  // namespace antilock::tutorial
