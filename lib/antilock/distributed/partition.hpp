#pragma once
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock::distributed {

/// Returns the rank of every triangle. Each rank has a strip in x with about the same number of
/// triangles. A strip ends where a column of the layer ends: if a strip cut a column, multigrid
/// would need up to four times as many iterations. Throws Error where there are fewer columns than
/// ranks, and, unless `any_layer`, where the layer is not made of columns (triangles between two
/// neighbouring vertical lines).
std::vector<int> strip_partition(const TriangleMesh& mesh, int ranks, bool any_layer = false);

/// Returns the mesh of the triangles of this rank. In this mesh an edge between two ranks has only
/// the triangle of this rank, and it keeps its tag. `rank_of` has one rank per triangle of the
/// coarse mesh.
TriangleMesh subdomain_of(const TriangleMesh& coarse, const std::vector<int>& rank_of, int rank);

/// Returns the mesh with every triangle cut into four by its edge midpoints. Triangle t becomes 4 t
/// ... 4 t + 3, as in mesh/refine.hpp, but the result is not checked. Both sides of an edge between
/// two ranks compute the same new vertex, to the last bit.
TriangleMesh refined_subdomain(const TriangleMesh& subdomain);

}  // namespace antilock::distributed
