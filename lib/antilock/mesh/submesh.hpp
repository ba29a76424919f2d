#pragma once
#include <functional>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Some triangles of a mesh as a mesh of their own, with the old numbers of its vertices. Where the mesh is cut it is
/// clamped, and Sigma is contact.
struct Submesh {
  TriangleMesh mesh;
  std::vector<int> old_vertex;
};
Submesh submesh(const TriangleMesh& mesh, const std::function<bool(int triangle)>& kept);
/// The body alone; a mesh without a layer as it is.
TriangleMesh body_submesh(const TriangleMesh& mesh);

}  // namespace antilock
