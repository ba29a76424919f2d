#pragma once
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock::distributed {

/// The rank of every triangle: strips in x with about as many triangles each, which end where a column of the layer
/// ends. A column cut by the end of a strip costs multigrid up to four times the iterations. Throws Error where there
/// are fewer columns than ranks, and, unless `any_layer`, where the layer is not made of columns (triangles between two
/// neighbouring vertical lines).
std::vector<int> strips(const TriangleMesh& mesh, int ranks, bool any_layer = false);

}  // namespace antilock::distributed
