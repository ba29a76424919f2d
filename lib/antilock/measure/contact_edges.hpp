#pragma once
#include <vector>

#include "antilock/space/space.hpp"

namespace antilock {

/// An edge of Gamma_C, the contact boundary, given by its triangle and the local vertex opposite to
/// it (mesh/quadrature.hpp: on_edge).
struct ContactEdge {
  int triangle, opposite;
  double length;  ///< dimensionless, as the mesh
};

/// Returns the edges with the tag `contact`, in the order of the mesh's edges.
std::vector<ContactEdge> contact_edges(const TriangleMesh& mesh);

/// Returns samples of v_h on Gamma_C, sorted by x, in the columns x, v_h and length of the sample.
/// Each edge has 32 samples, the midpoints of equal parts. So the vertices, where a nonconforming
/// v_h has two values, are not sampled.
Eigen::MatrixX3d contact_trace(const Space& space, const Eigen::VectorXd& v);

}  // namespace antilock
