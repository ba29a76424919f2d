#pragma once
#include <Eigen/Core>

#include "antilock/core/matrix.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// The method that turns "the bodies do not overlap" into finitely many linear constraints
/// (B. Wohlmuth, Acta Numerica 20, 2011).
///
///     mortar            weighted means of the jump [u] = u_slave - u_master, int psi_i [u]. For P1
///                       psi_i is the dual basis: on a slave edge with the barycentric coordinates
///                       a and b of its ends, 2 a - b and 2 b - a. Therefore int psi_i phi_j = 0
///                       for slave vertices i != j. For Crouzeix-Raviart psi_i is 1 on one slave
///                       edge.
///     node_to_segment   the value of [u] at each slave unknown (a vertex for P1, the midpoint of
///                       an edge for Crouzeix-Raviart)
enum class InterfaceMethod { mortar, node_to_segment };

/// C linear constraints on the jump [u] = u_slave - u_master along the straight interface of two
/// bodies, whose meshes need not match there. Each belongs to an unknown on the slave side that is
/// not prescribed, in the order of x (of y on a vertical interface).
struct InterfaceConstraints {
  /// C x N: row i is a weighted mean of [u]. Its entries on the slave side sum to 1, those on the
  /// master side to -1. It is 0 for every affine function of the place.
  RowMatrix jump;
  Points places;  ///< C x 2, the places of the slave unknowns
  /// C, int psi_i. A force lambda_i at constraint i is the pressure lambda_i / lengths_i, the
  /// coefficient of psi_i. For node_to_segment it is int phi_i over the slave side.
  Eigen::VectorXd lengths;
  Eigen::Vector2d normal;  ///< the unit normal of the interface, outwards of the slave's body
  Points points;           ///< Q x 2, the points at which the means are evaluated
  RowMatrix means;         ///< C x Q, row sums 1: the mean of g is means * g(points)
};

/// Returns the constraints between the edges with the tag `slave` and those with the tag `master`.
/// The mortar integrals are exact: Gauss's rule acts on the common refinement of both sides. Where
/// one end of a slave edge is prescribed, the function psi_i of the other end is 1 on that edge.
/// So the psi_i sum to 1 on the slave edges that have a free unknown, and there the forces of a
/// constant pressure are consistent.
/// Throws Error for another element than P1 or CR, for a tag without edges, for one tag twice, for
/// edges off the line of the slave side (by 1e-6 of its length), where both bodies are on one side
/// of this line, where the master edges do not cover every slave edge exactly once, and for an
/// unknown of both sides that is not prescribed.
InterfaceConstraints interface_constraints(const Space& space, EdgeTag slave, EdgeTag master,
                                           InterfaceMethod method);

/// Returns the rows for a displacement (u_x, u_y) with the unknowns of x before those of y (C x 2
/// N): the jump of its component in `direction`.
RowMatrix component_jump(const RowMatrix& jump, const Eigen::Vector2d& direction);

}  // namespace antilock
