#pragma once
#include <vector>

#include "antilock/space/space.hpp"

namespace antilock {

/// An edge of Gamma_C as its triangle sees it: opposite a local vertex (form/quadrature.hpp: on_edge).
struct ContactEdge {
  int triangle, opposite;
  double length;  ///< dimensionless, as the mesh
};

/// The edges with the tag `contact`, in the order of the mesh's edges.
std::vector<ContactEdge> contact_edges(const TriangleMesh& mesh);

/// v_h on Gamma_C between its unknowns, by x: x, v_h, and the length that the sample stands for, at 32 midpoints an edge.
/// A nonconforming v_h has two values at a vertex; neither is sampled.
Eigen::MatrixX3d contact_trace(const Space& space, const Eigen::VectorXd& v);

}  // namespace antilock
