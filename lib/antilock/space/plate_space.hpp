#pragma once
#include "antilock/space/vector_space.hpp"

namespace antilock {

/// The reduction of the shear strain grad w - theta in the energy (form/plate_forms.hpp).
enum class ShearRule { exact, mean, edges };

/// The space of a plate: a deflection w and a rotation theta = (theta_x, theta_y) on one mesh, and
/// the rule of their shear. With ShearRule::edges the rotation has one additional unknown per edge.
/// Its basis function is 6 lambda_j lambda_k times the unit tangent from the smaller vertex number
/// to the larger one. The tangential component has the mean 1 on the edge (R. Duran and E.
/// Liberman, Math. Comp. 58, 1992). The N unknowns are those of w, theta_x, theta_y and the edges,
/// in this order.
struct PlateSpace {
  Space deflection;
  VectorSpace rotation;
  ShearRule shear = ShearRule::exact;

  const TriangleMesh& mesh() const { return deflection.mesh(); }
  int theta_x() const { return deflection.size(); }  ///< first unknown of theta_x
  int theta_y() const { return theta_x() + rotation.x.size(); }
  int on_edges() const { return theta_y() + rotation.y.size(); }
  int size() const { return on_edges() + (shear == ShearRule::edges ? mesh().edge_count() : 0); }
};

}  // namespace antilock
