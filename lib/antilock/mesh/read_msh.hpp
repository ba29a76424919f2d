#pragma once
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Reads MSH 2.2 or 4.1 (ASCII) with the physical groups body, clamped, contact and, with a layer, layer and sigma
/// (sigma may be left out: it is where body meets layer). Throws Error or MeshError, `name` first, for a file that is missing,
/// binary, truncated, of another version, with other elements than points, lines and triangles, with unknown or
/// missing groups, or that make_triangle_mesh refuses.
/// `more` groups are accepted beside these: curves with their tags, after which no edge need be clamped, and surfaces,
/// which are parts of the body; `part` is filled with the place in `bodies` of each triangle, -1 for none.
struct ExtraGroups {
  std::map<std::string, EdgeTag> curves = {};
  std::vector<std::string> bodies = {};
};
TriangleMesh read_msh(const std::string& path, const ExtraGroups& more = {}, std::vector<int>* part = nullptr);
TriangleMesh read_msh(std::istream& in, const std::string& name, const ExtraGroups& more = {},
                      std::vector<int>* part = nullptr);

}  // namespace antilock
