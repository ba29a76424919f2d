#pragma once
#include <Eigen/SparseCore>

#include "antilock/form/factored_form.hpp"
#include "antilock/space/plate_space.hpp"

namespace antilock {

/// Returns the N x N matrix of the bending form of stiffness 1,
///
///     int (1 - nu) e(theta):e(phi) + nu div theta div phi,
///
/// e the symmetric gradient and nu Poisson's ratio (dimensionless). Its entries at deflections are
/// 0.
SparseMatrix bending_form(const PlateSpace& space, double poisson);

/// Returns the factored form of int R(grad w - theta) . R(grad v - phi). R is the reduction of the
/// shear rule of the space:
/// - `exact`: R is the identity. There are two rows per edge midpoint of a triangle, which is exact
///   if w and theta are P1.
/// - `mean`: R is the mean over a triangle. There are two rows per triangle, and M is the area.
/// - `edges`: R is the field a + b (-y, x) on the triangle that has the tangential means of the
///   strain on its three edges (Nedelec's element of lowest order). There are three rows per
///   triangle, for the value of the field at the centroid and for b. M is diagonal, because the
///   moment of (-y, x) about the centroid is 0.
FactoredForm shear_form(const PlateSpace& space);

}  // namespace antilock
