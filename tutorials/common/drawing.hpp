#pragma once
#include <filesystem>
#include <string>

namespace antilock::tutorial {

/// What the parts of Figures 1 and 2 are called: Figure 1 with epsilon in the names, Figure 2
/// without.
struct DomainNames {
  std::string layer, ends, contact, depth, note;
};

/// The domain with a layer of this depth, as a table of shapes: kind, name (its first word chooses
/// the colour), label, x, y; one row per corner. figures/pictures/domain.cpp reads it. The obstacle
/// is drawn apart from Gamma_C, to be seen; in the problem they touch where u = 0.
void write_drawing(const std::filesystem::path& path, double depth, const DomainNames& names);

}  // namespace antilock::tutorial
