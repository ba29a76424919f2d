#pragma once
#include <functional>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// A submesh: some triangles of a mesh, with the old numbers of its vertices. Where the mesh is cut it is
/// clamped, and Sigma is contact.
struct Submesh {
  TriangleMesh mesh;
  std::vector<int> old_vertex;
};
Submesh submesh(const TriangleMesh& mesh, const std::function<bool(int triangle)>& selected);
/// The body alone; a mesh without a layer as it is.
TriangleMesh body_submesh(const TriangleMesh& mesh);

}  // namespace antilock
