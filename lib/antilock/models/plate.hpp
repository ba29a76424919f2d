#pragma once
#include "antilock/form/plate_forms.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// A plate of Reissner and Mindlin, clamped, pressed by `load` on an obstacle below the whole of it (the thin structure
/// of the paper's introduction in two dimensions). Dimensionless: bending stiffness 1, shear stiffness 1/t^2. With E, nu
/// and the shear factor k = 5/6, t is the thickness over sqrt(6 k (1 - nu)) times the unit of length: 1.9 times thinner.
struct Plate {
  double thickness = 1e-4;                             ///< t, 0 to 1; 0 is Kirchhoff's plate
  double poisson = 0.3;                                ///< nu, 0 to less than 1
  Field load = [](double, double) { return -256.0; };  ///< force per area, upwards
  Field gap = [](double, double) { return 1.0; };      ///< of the obstacle below w = 0; infinity: no obstacle
  Field boundary_deflection = [](double, double) { return 0.0; };  ///< w on the clamped edges
  Field boundary_rotation_x = [](double, double) { return 0.0; };  ///< theta on the clamped edges
  Field boundary_rotation_y = [](double, double) { return 0.0; };
};

/// The problem (6) of the plate: a1 the bending form, a0 the shear form of the space, the class parameter t^2; w >= -gap
/// at every free unknown of w (vertices, for Crouzeix-Raviart the edge midpoints). On clamped edges a Crouzeix-Raviart
/// unknown is the mean of `boundary_deflection`. Throws Error for values out of range and for a rim held below the
/// obstacle.
VariationalInequality assemble(const Plate& plate, const PlateSpace& space);

}  // namespace antilock
