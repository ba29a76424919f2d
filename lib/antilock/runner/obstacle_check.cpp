#include "antilock/runner/obstacle_check.hpp"

#include <fmt/format.h>

namespace antilock {

void check_upper_obstacle_at(const UnilateralContact& contact, double x, double y, int dimension) {
  if (dimension == 2) return check_upper_obstacle(contact, x);
  if (!contact.upper_obstacle) return;
  UnilateralContact on_line;  // on the line of this y
  on_line.gap = [&](double at) { return contact.gap(at, y); };
  on_line.upper_obstacle = [&](double at) { return contact.upper_obstacle(at, y); };
  try {
    check_upper_obstacle(on_line, x);
  } catch (const ObstacleError& error) {
    throw ObstacleError(error.which, fmt::format("{}, at y = {:.6g}", error.what(), y));
  }
}

}  // namespace antilock
