#pragma once
#include "antilock/space/space.hpp"

namespace antilock {

/// A displacement (u_x, u_y) with a space per component on the same mesh: one element twice, or P1 and CR (Kouhia and
/// Stenberg 1995). Unknowns: those of x first, those of y behind them.
struct VectorSpace {
  Space x, y;
  int size() const { return x.size() + y.size(); }
};

}  // namespace antilock
