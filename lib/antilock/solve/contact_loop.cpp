#include "antilock/solve/contact_loop.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "antilock/core/error.hpp"

namespace antilock {

double ContactBounds::above(int i) const {
  return upper.size() > 0 ? upper(i) : std::numeric_limits<double>::infinity();
}

double ContactBounds::at(const HeldBounds& held, int i) const { return is_above(held, i) ? upper(i) : lower(i); }

HeldBounds ContactBounds::allowed(HeldBounds start) const {
  start.above.resize(upper.size());
  for (int i = 0; i < count(); ++i) {
    const bool low = std::isfinite(lower(i)), high = std::isfinite(above(i));
    if (is_equation(i)) start.active[i] = true;
    if (upper.size() > 0) start.above[i] = start.active[i] && high && (start.above[i] || !low);
    start.active[i] = start.active[i] && (low || high);
  }
  return start;
}

Eigen::VectorXd ContactBounds::nearest(const Eigen::VectorXd& v) const {
  return upper.size() > 0 ? Eigen::VectorXd(v.cwiseMax(lower).cwiseMin(upper)) : v.cwiseMax(lower);
}

HeldBounds ContactBounds::reached(const Eigen::VectorXd& v) const {
  HeldBounds held(std::vector<bool>(v.size()), std::vector<bool>(upper.size()));
  for (int i = 0; i < count(); ++i) {
    const bool high = v(i) >= above(i) && v(i) > lower(i);
    held.active[i] = v(i) <= lower(i) || high;
    if (upper.size() > 0) held.above[i] = high;
  }
  return held;
}

void ContactBounds::exchange(HeldBounds& held, int i, double v, double lambda, double stiffness) const {
  const bool active = held.active[i];
  const bool across = active && stiffness * (above(i) - lower(i)) < std::abs(lambda);
  const bool high = active ? across && !is_above(held, i) : v > above(i);
  held.active[i] = !active || across;
  if (upper.size() > 0) held.above[i] = high;
}

void throw_not_settled(int violations, int count, int steps) {
  throw NotConverged(
      fmt::format("contact: {} of {} contact conditions still violated after {} steps", violations, count, steps),
      static_cast<double>(violations) / count, steps);
}

}  // namespace antilock
