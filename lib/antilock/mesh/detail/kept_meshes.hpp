#pragma once
#include <functional>
#include <string>
#include <utility>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Vertices and triangles, all that a mesher hands over.
using MeshArrays = std::pair<Points, Triples>;

/// What `make` makes. Where the environment variable ANTILOCK_MESHES names a folder, the arrays are kept there under
/// `name`, and whoever asks for that name again reads them, in this program or in another one. So a name must say
/// everything that the mesh depends on but gmsh itself. A file of another size than its counts promise is made anew.
/// Meant for one run of many programs: tests/run, whose 300 programs ask 1,100 times for 50 meshes, empties the folder
/// before. Throws Error where the folder cannot be written.
MeshArrays kept_mesh(const std::string& name, const std::function<MeshArrays()>& make);

}  // namespace antilock
