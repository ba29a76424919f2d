#pragma once
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// The quadrature of the shear strain w' - theta on a cell, w the deflection and theta the
/// rotation. The choice changes only B and M.
enum class ShearIntegration {
  full,    ///< two Gauss points per cell, exact for P1/P1: locks
  reduced  ///< the midpoint: does not lock
};

/// Timoshenko's beam on (0, 1), clamped at both ends. A force `load` per length acts downwards, and
/// a flat obstacle lies at the distance `gap` below (the thin structure of the introduction of
/// [SR04], cited in problem/variational_inequality.hpp). It is dimensionless: the bending stiffness
/// is 1, the shear stiffness 1 / epsilon.
struct Beam {
  int cells = 64;         ///< of equal size, >= 2
  double epsilon = 1e-4;  ///< the class parameter, in [0, 1]; 0 is the Bernoulli beam
  double load = 5832;     ///< force per length, downwards
  double gap = 1;         ///< > 0
  ShearIntegration shear = ShearIntegration::reduced;
};

/// Assembles the problem (6) of the beam with P1 deflection w and rotation theta: a1 = int theta'
/// phi', a0 = int (w' - theta) (v' - phi), L = -load int v, w >= -gap. The unknowns are w_0,
/// theta_0, w_1, theta_1, ... (2 cells + 2); a1 alone is singular. Throws Error for values out of
/// range.
VariationalInequality assemble(const Beam& beam);

}  // namespace antilock
