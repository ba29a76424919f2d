#pragma once
// Chapter 20: its tables and its drawing.
#include "antilock/exact/truth_distance.hpp"
#include "backstage/20_parts.hpp"

namespace antilock::tutorial {

/// Theorem A at each epsilon, |.| in units of |f|; the last column in units of 1.
inline Table theorem_a(const std::vector<Exact>& truth, double load_norm) {
  Table norms({"epsilon", "(|u|^2 + 2 F^2) / |f|^2", "F / |f|", "|p| / |f|", "epsilon^1/2 |d/dx p|"});
  for (const Exact& exact : truth) {
    const Regularity u = regularity(exact.truth);
    norms.add({exact.epsilon, (u.body + 2 * u.layer) / (load_norm * load_norm), std::sqrt(u.layer) / load_norm,
               stress_norm(exact.truth) / load_norm, std::sqrt(exact.epsilon * u.stress_x)});
  }
  return norms;
}

/// All runs: what is bounded by h |f| or its square, in units of these; `half` is |u - I_h u|_a in units of (h/pi) |f|.
inline Table in_units(const Table& all, double load_norm) {
  Table units({"mesh", "cells", "epsilon", "CR", "P1", "half", "eta", "T_C", "Lemma B"});
  for (const Table& row : all.rows()) {
    const double unit = row.number("h") * load_norm;
    units.add({row.entry("mesh"), row.entry("cells"), row.entry("epsilon"), row.number("CR") / unit,
               row.number("P1") / unit, std::numbers::pi * row.number("interpolation") / unit,
               row.number("flux") / unit, row.number("contact") / (unit * unit),
               row.number("product") / (unit * unit)});
  }
  return units;
}

/// Prints the finest mesh in units; writes results.csv, errors.csv (of the structured mesh) and layer.csv.
inline void show_orders(const std::filesystem::path& out, const Table& all, const Table& units, const Table& limit) {
  units.where("cells", all.most("cells"))
      .print(
          "the finest mesh, T_C and Lemma B in (h |f|)^2, the rest in h |f|, half in (h/pi) |f| (proved on the "
          "structured "
          "mesh: 1.7, 1.3, 1, 0.601, 0.56, 0.56)",
          3);
  Table errors({"element", "mesh", "epsilon", "cells", "h", "error"});
  for (const Table& row : all.where("mesh", "structured").rows())
    for (const char* element : {"CR", "P1"})
      errors.add({element, "structured", row.entry("epsilon"), row.entry("cells"), row.entry("h"), row.entry(element)});
  all.write(out / "results.csv");
  errors.write(out / "errors.csv");
  limit.select({"mesh", "h", "layer"}).write(out / "layer.csv");
}

/// A triangle of a column and one of a row, for figures/pictures/domain.cpp.
inline void draw_triangles(const std::filesystem::path& path) {
  Table drawing({"kind", "name", "label", "x", "y"});
  const auto points = [&](const char* kind, const char* name, const std::vector<Eigen::Vector2d>& corners) {
    for (const auto& corner : corners) drawing.add({kind, name, "", corner(0), corner(1)});
  };
  const auto label = [&](const char* name, const char* text, double x, double y) {
    drawing.add({"label", name, text, x, y});
  };
  points("page", "", {{-0.75, -0.32}, {3.25, 1.25}});
  points("fill", "layer column", {{0, 0}, {0.87, 0.5}, {0, 1}});
  points("line", "layer_clamped", {{0, 0}, {0.87, 0.5}, {0, 1}});
  points("line", "sigma", {{0, 0}, {0, 1}});
  points("arrow", "sigma out", {{0, 0.5}, {-0.3, 0.5}});
  label("sigma", "$u_x$", -0.48, 0.5);
  label("axis", "a triangle of a column", 0.35, -0.2);
  points("fill", "layer row", {{1.85, 0}, {2.85, 0}, {2.35, 0.87}});
  points("line", "layer_clamped base", {{1.85, 0}, {2.85, 0}});
  points("line", "contact", {{2.85, 0}, {2.35, 0.87}, {1.85, 0}});
  points("arrow", "contact left", {{2.1, 0.435}, {1.84, 0.585}});
  points("arrow", "contact right", {{2.6, 0.435}, {2.86, 0.585}});
  label("contact", "$u_x$ and $p$", 1.55, 0.72);
  label("layer_clamped", "$p$", 2.35, 0.1);
  label("axis", "a triangle of a row", 2.35, -0.2);
  drawing.write(path);
}

}  // namespace antilock::tutorial
