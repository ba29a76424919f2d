#include "antilock/solve/contact_loop.hpp"

#include <fmt/format.h>

#include "antilock/core/error.hpp"

namespace antilock {

void throw_not_settled(int violations, int count, int steps) {
  throw NotConverged(
      fmt::format("contact: {} of {} contact conditions still violated after {} steps", violations, count, steps),
      static_cast<double>(violations) / count, steps);
}

}  // namespace antilock
