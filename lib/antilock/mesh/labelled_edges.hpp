#pragma once
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

/// An edge that carries a group. Its vertices are in the order of its first triangle, so that the
/// domain lies on the left of a boundary edge.
struct Labelled {
  int from, to, label;
};

/// Returns all edges that are not interior, in the order of their numbers.
std::vector<Labelled> labelled_edges(const TriangleMesh& mesh);

}  // namespace antilock
