#pragma once
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// An edge that carries a group, its vertices in the order of its first triangle: the domain lies on the left of a
/// boundary edge.
struct Labelled {
  int from, to, label;
};

/// All edges that are not interior, in the order of their numbers.
std::vector<Labelled> labelled_edges(const TriangleMesh& mesh);

}  // namespace antilock
