#pragma once
#include "antilock/form/mortar.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"
#include "antilock/space/vector_space.hpp"

namespace antilock {

/// Unilateral contact of two bodies along a straight interface, without friction. Both bodies are
/// components of one mesh. The tags of their sides are natural groups, free of other conditions.
struct TwoBodyContact {
  EdgeTag slave;   ///< the side whose unknowns have the constraints
  EdgeTag master;  ///< the other side, at least as long
  /// The distance of the bodies at the point (x, y) of the interface; negative: they overlap.
  Field gap = [](double, double) { return 0.0; };
  InterfaceMethod method = InterfaceMethod::mortar;
};

/// Assembles the anti-plane problem of a scene on a mesh of two bodies. It is the problem of
/// models/anti_plane.hpp for both bodies, with
///
///     K_h = { v : mean_i (v_above - v_below + gap) >= 0,  i = 1 ... C }
///
/// and the means of form/mortar.hpp. "Above" is the body that lies above the interface. Thus
/// lambda_i >= 0 is the force upwards on it and downwards on the other one. Throws Error as
/// `assemble` and interface_constraints do, for a scene that has a contact of its own, for a
/// vertical interface, and where the gap is not finite.
VariationalInequality assemble(const Scene& scene, const TwoBodyContact& contact,
                               const Space& space);

/// Replaces the bounds of a problem of plane strain by those of two bodies (unknowns of x before
/// those of y),
///
///     mean_i (n.(u_master - u_slave) + gap) >= 0,
///
/// with n the normal outwards of the slave's body: the bodies do not overlap. lambda_i >= 0 is the
/// force by which each body pushes the other one. Throws Error as interface_constraints does, where
/// the components have different spaces, and where the gap is not finite.
void set_normal_contact(VariationalInequality& problem, const TwoBodyContact& contact,
                        const VectorSpace& space);

/// Returns a row per constraint of a solved problem (C x 3): the x of its place, the mean distance
/// of the bodies, and the contact pressure, lambda_i / lengths_i.
Eigen::MatrixX3d interface_table(const InterfaceConstraints& constraints, const Bounds& bounds,
                                 const Eigen::VectorXd& u, const Eigen::VectorXd& lambda);

}  // namespace antilock
