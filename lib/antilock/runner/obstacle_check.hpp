#pragma once
#include "antilock/scene/scene.hpp"

namespace antilock {

/// Throws ObstacleError where the ceiling is below the obstacle at x, in space at (x, y)
/// (check_upper_obstacle, scene/scene.hpp).
void check_upper_obstacle_at(const UnilateralContact& contact, double x, double y, int dimension);

}  // namespace antilock
