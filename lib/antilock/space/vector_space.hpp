#pragma once
#include "antilock/space/space.hpp"

namespace antilock {

/// The space of a displacement (u_x, u_y), with a space per component on the same mesh. The
/// components have the same element, or P1 and CR (R. Kouhia and R. Stenberg, Comput. Methods Appl.
/// Mech. Eng. 124, 1995). The unknowns are those of x, then those of y.
struct VectorSpace {
  Space x, y;
  int size() const { return x.size() + y.size(); }
};

}  // namespace antilock
