#pragma once
// Figures 1 and 2 as shapes.
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// What the parts are called: Figure 1 with epsilon in the names, Figure 2 without.
struct DomainNames {
  std::string layer, ends, contact, depth, note;
};

/// The domain with a layer of this depth, as a table of shapes: kind, name (its first word
/// chooses the colour), label, x, y; one row per corner. figures/pictures/domain.cpp reads
/// it. The obstacle is drawn apart from Gamma_C, to be seen; in the problem they touch
/// where u = 0.
inline void write_drawing(const std::filesystem::path& path, double depth,
                          const DomainNames& names) {
  Table table({"kind", "name", "label", "x", "y"});
  const auto points = [&](const char* kind, const char* name,
                          const std::vector<Eigen::Vector2d>& corners) {
    for (const auto& corner : corners) table.add({kind, name, "", corner.x(), corner.y()});
  };
  const auto label = [&](const char* name, const std::string& text, double x, double y) {
    table.add({"label", name, text, x, y});
  };
  const double obstacle = -depth - 0.17;
  points("page", "", {{-0.45, obstacle - 0.2}, {1.45, 1.32}});
  points("fill", "body", {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  points("fill", "layer", {{0, -depth}, {1, -depth}, {1, 0}, {0, 0}});
  points("line", "sigma", {{0, 0}, {1, 0}});
  points("line", "contact", {{0, -depth}, {1, -depth}});
  points("line", "layer_clamped left", {{0, 0}, {0, -depth}});
  points("line", "layer_clamped right", {{1, 0}, {1, -depth}});
  points("line", "clamped", {{0, 0}, {0, 1}, {1, 1}, {1, 0}});
  points("obstacle", "obstacle", {{0, obstacle}, {1, obstacle}});
  points("arrow", "", {{0.2, -depth}, {0.2, -depth - 0.13}});
  points("dimension", "axis width", {{0, 1.2}, {1, 1.2}});
  points("dimension", "axis height", {{1.3, 0}, {1.3, 1}});
  points("dimension", "axis depth", {{1.3, -depth}, {1.3, 0}});
  points("arrow", "axis x", {{-0.38, obstacle - 0.1}, {-0.2, obstacle - 0.1}});
  points("arrow", "axis y", {{-0.38, obstacle - 0.1}, {-0.38, obstacle + 0.08}});

  label("", "$Ω^+$", 0.5, 0.5);
  label("", names.layer, 0.5, -0.5 * depth);
  if (!names.note.empty()) label("axis", names.note, 0.5, -0.5 * depth - 0.12);
  label("sigma", "$Σ$", 0.8, 0.06);
  for (const auto& [x, y] : {std::pair{0.5, 1.07}, {-0.09, 0.5}, {1.09, 0.5}})
    label("clamped", "$Γ^+$", x, y);
  for (const double x : {-0.13, 1.13}) label("layer_clamped", names.ends, x, -0.5 * depth);
  label("contact", names.contact, 0.55, -depth - 0.075);
  label("", "$n$", 0.25, -depth - 0.09);
  label("axis", "rigid obstacle", 0.5, obstacle - 0.1);
  label("axis", "1", 0.5, 1.25);
  label("axis", "1", 1.35, 0.5);
  label("axis", names.depth, 1.35, -0.5 * depth);
  label("axis", "$x$", -0.16, obstacle - 0.1);
  label("axis", "$y$", -0.38, obstacle + 0.12);
  table.write(path);
}

}  // namespace antilock::tutorial
