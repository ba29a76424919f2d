#pragma once
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// The number of a tag's physical group in MSH and FreeFEM files: sigma 3, clamped 4, contact 5, free 6, a named group
/// k 10 + k, with Dirichlet data 1000 + k. From k = 990 on 1000 + k without them, too: each k is one group, so that no
/// two groups have one number. 0 for interior.
int physical_number(EdgeTag tag);

/// An edge that carries a group, its vertices in the order of its first triangle: the domain lies on the left of a
/// boundary edge.
struct Labelled {
  int from, to, label;
};

/// All edges that are not interior, in the order of their numbers.
std::vector<Labelled> labelled_edges(const TriangleMesh& mesh);

}  // namespace antilock
