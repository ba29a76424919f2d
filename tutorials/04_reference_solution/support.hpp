#pragma once
// The picture of chapter 04.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// u_k(y) under a pressure sin(k pi x) on Gamma_C alone, 1 there: one row per y from -1 to
/// 1, one column per epsilon and k = 1, 2, 4, 8, named 0_1, ..., 1_8. symbol(k, epsilon) is
/// the stiffness.
inline Table modes(const std::vector<double>& epsilons,
                   const std::function<double(int, double)>& symbol) {
  std::vector<std::string> columns{"y"};
  for (std::size_t e = 0; e < epsilons.size(); ++e)
    for (const int k : {1, 2, 4, 8}) columns.push_back(fmt::format("{}_{}", e, k));
  Table table(columns);
  for (int j = -100; j <= 100; ++j) {
    const double y = j / 100.0;
    std::vector<TableEntry> row{y};
    for (const double epsilon : epsilons)
      for (const int k : {1, 2, 4, 8}) {
        const double a = k * std::numbers::pi, kappa = epsilon * a,
                     s = symbol(k, epsilon) * epsilon / a;
        const auto layer = [&](double eta) {  // cosh - s sinh, by decaying parts: (1 - s)
                                              // e^x + (1 + s) e^-x over 2
          return 0.5 * ((1 - s) * std::exp(kappa * eta) + (1 + s) * std::exp(-kappa * eta));
        };
        row.emplace_back(y <= 0 ? layer(1 + y)
                                : layer(1) * std::sinh(a * (1 - y)) / std::sinh(a));
      }
    table.add(row);
  }
  return table;
}

}  // namespace antilock::tutorial
