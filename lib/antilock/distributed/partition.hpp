#pragma once
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock::distributed {

/// Returns the rank of every triangle. Each rank has a strip in x with about the same number of
/// triangles. Columns are the ranges of x between neighbouring vertices of Gamma_C, and a triangle
/// lies in the column of its centroid. A strip consists of whole columns: if a strip cut a column
/// of the layer, multigrid would need up to four times as many iterations. Throws Error where there
/// are fewer columns than ranks.
std::vector<int> strip_partition(const TriangleMesh& mesh, int ranks);

/// Returns a triangle of the layer that crosses a vertical line through a vertex of Gamma_C, or -1
/// if there is none. Then the layer is made of columns, and so is that of every refinement.
int find_triangle_across_columns(const TriangleMesh& mesh);

/// Returns the mesh of the triangles of this rank. In this mesh an edge between two ranks has only
/// the triangle of this rank, and it keeps its tag. `rank_of` has one rank per triangle of the
/// coarse mesh.
TriangleMesh subdomain_of(const TriangleMesh& coarse, const std::vector<int>& rank_of, int rank);

/// Returns the mesh with every triangle cut into four by its edge midpoints. Triangle t becomes 4 t
/// ... 4 t + 3, as in mesh/refine.hpp, but the result is not checked. Both sides of an edge between
/// two ranks compute the same new vertex, to the last bit.
TriangleMesh refined_subdomain(const TriangleMesh& subdomain);

}  // namespace antilock::distributed
