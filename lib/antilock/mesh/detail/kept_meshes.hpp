#pragma once
#include <functional>
#include <string>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// What a mesher hands over: the arguments of make_triangle_mesh.
struct MeshArrays {
  Points vertices;
  Triples triangles;
  std::vector<Region> region;
  std::vector<TaggedEdge> tagged;
};

/// What `make` makes. Where the environment variable ANTILOCK_MESHES names a folder, the arrays are kept there under
/// `name`, and whoever asks for that name again reads them, in this program or in another one. So a name must say
/// everything that the mesh depends on but gmsh itself. A file of another size than its counts promise is made anew.
/// Meant for one run of many programs: tests/run, whose 300 programs ask 1,100 times for 50 meshes, empties the folder
/// before. Throws Error where the folder cannot be written.
MeshArrays kept_mesh(const std::string& name, const std::function<MeshArrays()>& make);

}  // namespace antilock
