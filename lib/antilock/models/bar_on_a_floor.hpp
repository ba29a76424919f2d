#pragma once
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// A bar of stiffness 1, held at x = 0, pulled by `pull` at x = 1, on a floor with g = 1 per length: it slips on the
/// last `pull` of it, u = (x - 1 + pull)^2 / 2 there.
VariationalInequality bar_on_a_floor(int n, double pull);

}  // namespace antilock
