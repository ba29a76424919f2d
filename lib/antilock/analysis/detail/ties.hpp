#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// How many groups the layer's triangles are in: two that share an edge which is not vertical are tied together, and so
/// are those that they are tied to. On a group a conforming function without slope in y is one polynomial in x.
int tied_groups(const TriangleMesh& mesh);

/// Each group is a column, between two neighbours on Sigma: a group per edge of Sigma, side by side.
bool in_columns(const TriangleMesh& mesh);

}  // namespace antilock
