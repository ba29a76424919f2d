#pragma once
#include "antilock/form/plate_forms.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// A clamped plate of Reissner and Mindlin, pressed by `load` on an obstacle below all of it (the
/// thin structure of the introduction of [SR04], cited in problem/variational_inequality.hpp, in
/// two dimensions). It is dimensionless: the bending stiffness is 1, the shear stiffness 1 / t^2. t
/// is the thickness in the unit of length, divided by sqrt(6 k (1 - nu)), where nu is Poisson's
/// ratio and k = 5/6 the shear factor. For nu = 0.3 this root is 1.9.
struct Plate {
  double thickness = 1e-4;                             ///< t, 0 to 1; 0 is Kirchhoff's plate
  double poisson = 0.3;                                ///< nu, 0 to less than 1
  Field load = [](double, double) { return -256.0; };  ///< force per area, upwards
  /// Distance of the obstacle below w = 0; infinity: none.
  Field gap = [](double, double) { return 1.0; };
  Field boundary_deflection = [](double, double) { return 0.0; };  ///< w on the clamped edges
  Field boundary_rotation_x = [](double, double) { return 0.0; };  ///< theta on the clamped edges
  Field boundary_rotation_y = [](double, double) { return 0.0; };
};

/// Assembles the problem (6) of the plate: a1 is the bending form, a0 the shear form of the space,
/// and the class parameter is t^2. The bound w >= -gap holds at every free unknown of w (vertices,
/// for Crouzeix-Raviart edge midpoints). On clamped edges a Crouzeix-Raviart unknown is the mean of
/// `boundary_deflection`. Throws Error for values out of range and for a boundary deflection below
/// the obstacle.
VariationalInequality assemble(const Plate& plate, const PlateSpace& space);

}  // namespace antilock
