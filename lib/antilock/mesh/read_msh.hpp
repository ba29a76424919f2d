#pragma once
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Groups that read_msh accepts beside the usual ones: curves with their tags, and surfaces, which
/// are parts of the body. In space they are surfaces with their tags, and volumes. With such curves
/// no edge needs to be clamped.
struct ExtraGroups {
  std::map<std::string, EdgeTag> curves = {};
  std::vector<std::string> bodies = {};
  bool needs_contact = true;  ///< whether the file must have the group contact
};
/// Reads a file of MSH 2.2 or 4.1 (ASCII) with the physical groups body, clamped, contact and, with
/// a layer, layer and sigma. A file with tetrahedra is a mesh in space. There body and layer are
/// groups of volumes, the others are groups of surfaces, and curves carry nothing. The group sigma
/// may be absent, because its facets are those between body and layer. `part` receives for each
/// cell the index of its group in `more.bodies`, or -1. Throws Error or MeshError, whose message
/// begins with `name`, for a file that is missing, binary, truncated or of another version, for
/// other elements than points, lines, triangles and tetrahedra, for unknown or missing groups, and
/// where make_mesh throws.
TriangleMesh read_msh(const std::string& path, const ExtraGroups& more = {},
                      std::vector<int>* part = nullptr);
TriangleMesh read_msh(std::istream& in, const std::string& name, const ExtraGroups& more = {},
                      std::vector<int>* part = nullptr);

/// Returns 3 where a MSH file names a physical group of volumes, and 2 else, also for a file that
/// cannot be read. Only the names are read, from the first megabyte of the file.
int named_dimension(const std::string& path);

}  // namespace antilock
