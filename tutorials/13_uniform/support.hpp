#pragma once
#include <algorithm>
#include <filesystem>

#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// Quarter decades of epsilon from 1 to 1e-10, and 0.
inline std::vector<double> quarter_decades() {
  std::vector<double> list;
  for (int k = 0; k <= 40; ++k) list.push_back(std::pow(10.0, -0.25 * k));
  list.push_back(0);
  return list;
}

/// results.csv, all runs; map.csv, the picture of what P1 loses over what it keeps, from
/// 0.01 to 100 for epsilon from 0.1 to 2e-4.
inline void write_map(const std::filesystem::path& out, const Table& all) {
  all.write(out / "results.csv");
  Table map({"mesh", "epsilon", "h", "lost_to_kept"});
  const auto drawn = [](double epsilon) { return epsilon > 1.5e-4 && epsilon < 0.11; };
  for (const Table& row :
       all.filter("element", "P1").filter_number("epsilon", drawn).rows())
    map.add({row.entry("mesh"), row.number("epsilon"), row.number("h"),
             std::clamp(row.number("lost_to_kept"), 0.01, 100.0)});
  map.write(out / "map.csv");
}

/// uniform.csv: the worst errors of the four methods of Figure 9 in two norms.
inline void write_uniform(const std::filesystem::path& out,
                          const std::vector<std::pair<Method, Table>>& worst) {
  Table uniform({"norm", "element", "mesh", "h", "worst"});
  for (const auto& [method, table] : worst)
    for (const Table& row : table.rows())
      for (const auto& [norm, column] :
           {std::pair{"broken $H^1$ norm", "h1"}, {"energy seminorm", "energy"}})
        if (method.family.name.ends_with("structured"))
          uniform.add({norm, method.element->name(), method.family.name, row.number("h"),
                       row.number(column)});
  uniform.write(out / "uniform.csv");
}

}  // namespace antilock::tutorial
