#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// What the layer's triangles are to each other: two that share an edge which is not vertical are tied together, and so are
/// those that they are tied to. On a group of them a conforming function without slope in y is one polynomial in x.
struct LayerComponents {
  int count = 0;
  bool is_aligned = false;  ///< each group is between two neighbours on Sigma: one per edge of Sigma, side by side
};
LayerComponents layer_components(const TriangleMesh& mesh);

}  // namespace antilock
