#pragma once
#include <array>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Returns the number of the physical group of a tag in MSH and FreeFEM files:
///
///     interior 0, sigma 3, clamped 4, contact 5, free 6,
///     named group k: 10 + k without Dirichlet data, 1000 + k with them
///
/// From k = 990 on it is 1000 + k also without Dirichlet data, because 10 + k could be the number
/// of another group.
int physical_number(EdgeTag tag);

/// A facet that carries a group. Its d vertices are in the order of its first cell, so that the
/// domain lies on the left of a boundary edge, and the normal of a boundary face points outwards.
struct Labelled {
  std::array<int, 3> vertices;  ///< d of them; of an edge the third is -1
  int label;
};

/// Returns all facets that are not interior, in the order of their numbers.
std::vector<Labelled> labelled_edges(const TriangleMesh& mesh);

}  // namespace antilock
