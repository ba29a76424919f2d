#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// The connected components of the layer's triangles, where two are connected by a common edge that is not vertical. On
/// a component a conforming function without slope in y is one polynomial in x.
struct LayerComponents {
  int count = 0;
  bool is_aligned = false;  ///< the mesh is aligned with the layer (in columns: vertical mesh lines, as in an
                            ///< extruded mesh): one component below each edge of Sigma
};
LayerComponents layer_components(const TriangleMesh& mesh);

}  // namespace antilock
