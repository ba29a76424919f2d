#pragma once
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// Assembles a bar of stiffness 1 on (0, 1) in n cells, fixed at x = 0 and pulled by the force
/// `pull` at x = 1, on a floor with the friction limit g = 1 per length. For `pull` from 0 to 1 the
/// exact solution slips on the part of length `pull` at the end x = 1. There u = (x - 1 + pull)^2 /
/// 2, and u = 0 elsewhere. Everything is dimensionless.
VariationalInequality bar_on_a_floor(int n, double pull);

}  // namespace antilock
