#pragma once
#include <iosfwd>
#include <string>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Reads MSH 2.2 or 4.1 (ASCII) with the physical groups body, clamped, contact and, with a layer, layer and sigma
/// (sigma may be left out: it is where body meets layer). Throws Error, `name` first, for a file that is missing,
/// binary, truncated, of another version, with other elements than points, lines and triangles, with unknown or
/// missing groups, or that make_triangle_mesh refuses.
TriangleMesh read_msh(const std::string& path);
TriangleMesh read_msh(std::istream& in, const std::string& name);

}  // namespace antilock
