#pragma once
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock::distributed {

/// The rank of every triangle: strips in x with about as many triangles each, which end where a column of the layer
/// ends. A column cut by the end of a strip costs multigrid up to four times the iterations. Throws Error where there
/// are fewer columns than ranks, and, unless `any_layer`, where the layer is not made of columns (triangles between two
/// neighbouring vertical lines).
std::vector<int> strip_partition(const TriangleMesh& mesh, int ranks, bool any_layer = false);

/// What the rank holds of a mesh: its own triangles, as a mesh in which an edge between two ranks has one triangle and
/// keeps its tag. rank_of: of every triangle of the coarse mesh.
TriangleMesh subdomain_of(const TriangleMesh& coarse, const std::vector<int>& rank_of, int rank);

/// Every triangle cut into four by its edge midpoints, triangle t into 4 t ... 4 t + 3, as mesh/refine.hpp does, but
/// without a check. Both sides of an edge between two ranks get the same new vertex, to the last bit.
TriangleMesh refined_subdomain(const TriangleMesh& subdomain);

}  // namespace antilock::distributed
