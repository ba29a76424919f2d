#pragma once
#include <functional>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// A submesh: some cells of a mesh, with the old numbers of its vertices. A facet at which the mesh
/// is cut becomes clamped, except for the facets of Sigma, between body and layer. They get the tag
/// contact. make_mesh refuses quadrilaterals.
struct Submesh {
  TriangleMesh mesh;
  std::vector<int> old_vertex;
};
Submesh submesh(const TriangleMesh& mesh, const std::function<bool(int cell)>& selected);
/// Returns the mesh of the body alone; a mesh without a layer is returned unchanged.
TriangleMesh body_submesh(const TriangleMesh& mesh);

}  // namespace antilock
