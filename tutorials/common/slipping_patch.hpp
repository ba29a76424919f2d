#pragma once
#include "antilock/space/vector_space.hpp"

namespace antilock::tutorial {

/// The largest error of u in a patch test with friction and slip, which an element that holds affine functions passes to
/// round-off, at any epsilon = 1/lambda, 0 included.
///
/// The unit square is pressed by 0.1 on a flat floor that rubs with g = 0.1, its left side is dragged to the right, and
/// everything slips: u_x = 0.05 + a x + g y, u_y = -0.1 y, a = 0.1 / (1 + 2 epsilon). The strain is uniform. The floor
/// bears g per length and so does every section, hence top and sides get their share of g as a load.
double slipping_patch_error(const VectorSpace& space, double jump_weight, double epsilon);

}  // namespace antilock::tutorial
