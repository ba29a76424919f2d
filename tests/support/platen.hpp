#pragma once
#include "antilock/models/plane_strain.hpp"

namespace antilock::test {

/// A gap under a block in plane strain: contact begins in its middle.
inline double parabola(double x) { return (x - 0.5) * (x - 0.5); }

/// The block over that gap.
inline PlaneStrain platen(double epsilon, double jump_weight = 0) {
  return {Press{.gap = parabola, .jump_weight = jump_weight}, epsilon};
}

}  // namespace antilock::test
