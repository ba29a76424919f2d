#pragma once
#include "antilock/space/vector_space.hpp"

namespace antilock {

/// What of the shear strain grad w - theta the energy sees (form/plate_forms.hpp).
enum class ShearRule { exact, mean, edges };

/// A deflection w and a rotation theta = (theta_x, theta_y) of one mesh, and how their shear is taken. With
/// ShearRule::edges the rotation has one unknown more per edge: 6 lambda_j lambda_k times the unit tangent from the
/// smaller vertex to the larger, whose mean on the edge is 1 (Duran and Liberman 1992). N unknowns: those of w, theta_x,
/// theta_y and the edges.
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
