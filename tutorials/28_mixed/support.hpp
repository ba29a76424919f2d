#pragma once
#include "antilock/study/table.hpp"
#include "course/add_row.hpp"
#include "course/chapter.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

/// One row per projection, mesh and epsilon: its H1 error and corrections, and of the mesh
/// alpha of (i), the distance from u^0 to K_0h of (ii), the slope that K_0h hides of (iii);
/// and the seconds of the solution.
inline const std::vector<std::string> projection_columns{
    "name", "h", "epsilon", "h1", "alpha", "near", "hidden", "corrections", "seconds"};

/// What columns hide in the limit: the v that they do not see are equal on Sigma and on
/// Gamma_C (exercise 3 of the page).
inline double slope_hidden_by_columns() {
  using std::numbers::pi;
  const double kappa = std::sqrt(pi * pi + 1), sum = kappa * kappa + pi * pi;
  return pi * std::sqrt(0.5 * (0.5 - 2 * kappa / std::tanh(kappa / 2) / sum) / sum);
}

/// Hypotheses beside conclusion, one row per projection and mesh: prints them; writes
/// projections.csv and layer.csv.
inline void show_projections(const std::filesystem::path& out, const Table& layer) {
  Table rows({"strain", "h", "alpha", "dist(u^0, K_0h)", "slope hidden", "sup error",
              "order", "locking ratio", "seconds"});
  Table picture({"name", "h", "worst"});
  for (const TableEntry& name : layer.unique("name")) {
    const Table own = layer.filter("name", name);
    for (const Table& worst : supremum(own, "h1", "epsilon").rows.rows()) {
      const Table mesh = own.filter("h", worst.entry("h"));
      const double alpha = mesh.first("alpha");
      const double ratio = worst.number("worst") / mesh.filter("epsilon", 1).number("h1");
      add_row(rows, {{"strain", name},
                     {"h", worst.entry("h")},
                     {"alpha", std::isfinite(alpha) ? TableEntry(alpha) : ""},
                     {"dist(u^0, K_0h)", mesh.first("near")},
                     {"slope hidden", mesh.first("hidden")},
                     {"sup error", worst.entry("worst")},
                     {"order", worst.entry("order")},
                     {"locking ratio", ratio},
                     {"seconds", mesh.max("seconds")}});
      picture.add({name, worst.entry("h"), worst.entry("worst")});
    }
  }
  rows.print("Theorem 4 for another a0: (i), (ii), (iii), and the conclusion", 3);
  layer.filter("h", layer.min("h"))
      .pivot("name", "epsilon", "h1")
      .print("H1 error on the finest mesh, by epsilon", 3);
  picture.write(out / "projections.csv");
  layer.write(out / "layer.csv");
}

}  // namespace antilock::tutorial
