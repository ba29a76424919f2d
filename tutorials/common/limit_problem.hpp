#pragma once
#include "antilock/exact/truth_distance.hpp"

namespace antilock::tutorial {

/// What is lost where the layer locks.
inline double limit_on_layer(const Truth& limit) { return layer_norm(limit); }

}  // namespace antilock::tutorial
