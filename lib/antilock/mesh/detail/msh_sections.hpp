#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "antilock/mesh/detail/msh_lines.hpp"

namespace antilock {

struct FileNode {
  std::int64_t tag;
  double x, y;
};

/// A point, line or triangle: 1, 2 or 3 nodes.
struct FileElement {
  std::int64_t tag;
  std::int64_t group;  ///< MSH 2.2: the physical group; 4.1: the entity, whose group $Entities tells
  int size;
  std::array<std::int64_t, 3> nodes;
  int line;
  int dimension() const { return size - 1; }
};

/// Dimension and number of a physical group or an entity.
using Place = std::pair<int, std::int64_t>;

/// A MSH file as it stands, its tags not yet resolved.
struct MshFile {
  bool version_4 = false;
  std::map<Place, std::string> names;      ///< of the physical groups of curves and surfaces
  std::map<Place, std::int64_t> entities;  ///< 4.1: the physical group of a curve or surface, 0 for none
  std::vector<FileNode> nodes;
  std::vector<FileElement> elements;
};

constexpr std::array dimension_names = {"point", "curve", "surface", "volume"};

/// Reads and checks every section that a mesh needs, 2.2 or 4.1; throws Error at the first fault.
/// `more`: the names that it may have beside body, layer, sigma, clamped and contact, with their dimensions.
MshFile read_sections(MshLines& lines, const std::map<std::string, int>& more = {});

}  // namespace antilock
