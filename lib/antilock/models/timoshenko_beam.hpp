#pragma once
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// How the shear strain w' - theta of a cell is integrated: two choices of B, nothing else.
enum class ShearIntegration {
  full,    ///< two Gauss points a cell, exact for P1/P1: locks
  reduced  ///< the midpoint: does not lock
};

/// Timoshenko's beam on (0, 1), clamped at both ends, under the load -load over a flat obstacle at distance gap below
/// (the thin structure of the paper's introduction). Dimensionless: bending stiffness 1, shear stiffness 1/epsilon.
struct Beam {
  int cells = 64;         ///< of equal size, >= 2
  double epsilon = 1e-4;  ///< the class parameter, in [0, 1]; 0 is the Bernoulli beam
  double load = 5832;     ///< force a unit length, downwards
  double gap = 1;         ///< > 0
  ShearIntegration shear = ShearIntegration::reduced;
};

/// The problem (6) of the beam: P1 deflection w and rotation theta, a1 = int theta' phi', a0 = int (w' - theta)(v' -
/// phi), L = -load int v, w >= -gap. Unknowns w_0, theta_0, w_1, theta_1, ... (2 cells + 2); a1 alone is singular.
/// Throws Error for values out of range.
VariationalInequality assemble(const Beam& beam);

}  // namespace antilock
