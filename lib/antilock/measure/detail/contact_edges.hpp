#pragma once
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// An edge of Gamma_C as its triangle sees it: opposite local vertex i, from vertex i + 1 (s = 0) to i + 2 (s = 1).
struct ContactEdge {
  int triangle, opposite;
  double length;  ///< dimensionless, as the mesh

  Eigen::Vector3d lambda(double s) const;  ///< barycentric coordinates of the place s in [0, 1]
};

/// The edges with the tag `contact`, in the order of the mesh's edges.
std::vector<ContactEdge> contact_edges(const TriangleMesh& mesh);

}  // namespace antilock
