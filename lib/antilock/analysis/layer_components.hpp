#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// The connected components of the layer's cells. Two triangles are connected where they share an
/// edge that is not vertical, and two tetrahedra where they share a face that is not vertical. On a
/// component a conforming function whose derivative across the layer is 0 is one polynomial in x,
/// and in space one in x and y.
struct LayerComponents {
  int count = 0;
  /// Whether the mesh is aligned with the layer: its lines are vertical, as in an extruded mesh, so
  /// that there is one component below each edge (in space, each face) of Sigma, the interface of
  /// body and layer.
  bool is_aligned = false;
};
/// Throws Error for a mesh of quadrilaterals.
LayerComponents layer_components(const Mesh& mesh);

}  // namespace antilock
