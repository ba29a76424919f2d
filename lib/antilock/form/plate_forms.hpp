#pragma once
#include <Eigen/SparseCore>

#include "antilock/form/factored_form.hpp"
#include "antilock/space/plate_space.hpp"

namespace antilock {

/// N x N matrix of int (1 - nu) e(theta):e(phi) + nu div theta div phi, e the symmetric gradient: the bending energy of
/// stiffness 1, nu Poisson's ratio (dimensionless). It holds no deflection.
SparseMatrix bending_form(const PlateSpace& space, double poisson);

/// The factored form of int R(grad w - theta).R(grad v - phi), R what the shear rule of the space sees:
/// - `exact`: R the identity; two rows per edge midpoint of a triangle, exact for P1 and P1;
/// - `mean`: R the mean over a triangle; two rows, M its area;
/// - `edges`: R the field a + b (-y, x) on the triangle with the tangential means of the strain on its three edges
///   (Nedelec's lowest order): its value at the centroid and b, three rows. M is diagonal: the moment of (-y, x) about
///   the centroid is 0.
FactoredForm shear_form(const PlateSpace& space);

}  // namespace antilock
