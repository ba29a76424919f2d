#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// The connected components of the layer's triangles. Two triangles are connected where they share
/// an edge that is not vertical. On a component a conforming function v with d_y v = 0 is one
/// polynomial in x.
struct LayerComponents {
  int count = 0;
  /// Whether the mesh is aligned with the layer: its lines are vertical, as in an extruded mesh, so
  /// that there is one component below each edge of Sigma, the interface of body and layer.
  bool is_aligned = false;
};
LayerComponents layer_components(const TriangleMesh& mesh);

}  // namespace antilock
