#include "antilock/solve/contact_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace antilock {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

double ContactBounds::above(int i) const { return upper.size() > 0 ? upper(i) : infinity; }

double ContactBounds::bears(int i) const { return most.size() > 0 ? most(i) : infinity; }

double ContactBounds::at(const HeldBounds& held, int i) const { return is_above(held, i) ? upper(i) : lower(i); }

ContactBounds::Interval ContactBounds::forces(const HeldBounds& held, int i) const {
  const bool up = is_above(held, i), both = is_equation(i);
  return {up || both ? -bears(i) : 0, up && !both ? 0 : bears(i)};
}

ContactBounds::Interval ContactBounds::piece(const HeldBounds& held, int i) const {
  const int beyond = is_beyond(held, i);
  return {beyond < 0   ? -infinity
          : beyond > 0 ? above(i)
                       : lower(i),
          beyond < 0   ? lower(i)
          : beyond > 0 ? infinity
                       : above(i)};
}

double ContactBounds::given(const HeldBounds& held, int i) const {
  const int beyond = is_beyond(held, i);
  return held.active[i] || beyond == 0 ? 0 : -beyond * bears(i);
}

Eigen::VectorXd ContactBounds::given(const HeldBounds& held) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(count());
  for (int i = 0; i < count(); ++i) forces(i) = given(held, i);
  return forces;
}

void ContactBounds::put(HeldBounds& held, int i, bool active, bool at_upper, int beyond) const {
  held.active[i] = active;
  if (upper.size() > 0) held.above[i] = active && at_upper;
  if (most.size() > 0) held.beyond[i] = active ? 0 : beyond;
}

HeldBounds ContactBounds::allowed(HeldBounds start) const {
  start.above.resize(upper.size());
  start.beyond.resize(most.size());
  for (int i = 0; i < count(); ++i) {
    const bool low = std::isfinite(lower(i)), high = std::isfinite(above(i));
    const int beyond = is_beyond(start, i);
    if (!start.active[i] && std::isfinite(bears(i)) && ((beyond < 0 && low) || (beyond > 0 && high))) continue;
    const bool active = (start.active[i] || is_equation(i)) && (low || high);
    put(start, i, active, high && (is_above(start, i) || !low), 0);
  }
  return start;
}

Eigen::VectorXd ContactBounds::nearest(const Eigen::VectorXd& v) const {
  Eigen::VectorXd inside = upper.size() > 0 ? Eigen::VectorXd(v.cwiseMax(lower).cwiseMin(upper)) : v.cwiseMax(lower);
  for (Eigen::Index i = 0; i < most.size(); ++i)
    if (std::isfinite(most(i))) inside(i) = v(i);
  return inside;
}

HeldBounds ContactBounds::reached(const Eigen::VectorXd& v) const {
  HeldBounds held(std::vector<bool>(v.size()), std::vector<bool>(upper.size()), std::vector<int>(most.size()));
  for (int i = 0; i < count(); ++i) {
    const bool soft = std::isfinite(bears(i)), high = v(i) >= above(i) && v(i) > lower(i);
    const bool outside = soft && (v(i) < lower(i) || v(i) > above(i));
    put(held, i, !outside && (v(i) <= lower(i) || high), high, v(i) < lower(i) ? -1 : outside ? 1 : 0);
  }
  return held;
}

Eigen::VectorXd ContactBounds::nearest(const HeldBounds& held, Eigen::VectorXd v) const {
  for (int i = 0; i < count(); ++i) {
    const Interval p = piece(held, i);
    v(i) = held.active[i] ? at(held, i) : std::min(std::max(v(i), p.low), p.high);
  }
  return v;
}

HeldBounds ContactBounds::downhill(const Eigen::VectorXd& v, const Eigen::VectorXd& lambda) const {
  HeldBounds held = reached(v);
  for (int i = 0; i < count(); ++i) {
    if (!held.active[i]) continue;
    const Interval f = forces(held, i);
    if (lambda(i) <= f.low || lambda(i) >= f.high) let_go(held, i, lambda(i) <= f.low);
  }
  return held;
}

ContactBounds::Stretch ContactBounds::hold_first_end(HeldBounds& held, const Eigen::VectorXd& v,
                                                     const Eigen::VectorXd& direction) const {
  Stretch stretch;
  for (int i = 0; i < count(); ++i) {
    if (held.active[i] || direction(i) == 0) continue;
    const Interval p = piece(held, i);
    const double t = std::max(0.0, (direction(i) > 0 ? p.high - v(i) : p.low - v(i)) / direction(i));
    if (t < stretch.t) stretch = {t, i};
  }
  if (const int i = stretch.ended; i >= 0) hold_end(held, i, direction(i) > 0);
  return stretch;
}

void ContactBounds::hold_end(HeldBounds& held, int i, bool high_end) const {
  const int beyond = is_beyond(held, i);
  put(held, i, true, beyond == 0 ? high_end : beyond > 0, 0);
}

void ContactBounds::let_go(HeldBounds& held, int i, bool upwards) const {
  const bool outer = is_equation(i) || is_above(held, i) == upwards;
  put(held, i, false, false, !outer ? 0 : upwards ? 1 : -1);
}

void ContactBounds::exchange(HeldBounds& held, int i, double v, double lambda, double stiffness) const {
  if (held.active[i]) {
    const bool was_above = is_above(held, i);
    let_go(held, i, lambda < forces(held, i).low);
    const bool across = is_beyond(held, i) == 0 && stiffness * (above(i) - lower(i)) < std::abs(lambda);
    if (across) put(held, i, true, !was_above, 0);
    return;
  }
  const Interval p = piece(held, i);
  const int side = v > p.high ? 1 : -1, beyond = is_beyond(held, i);
  const double past = side > 0 ? v - p.high : p.low - v;
  const bool across = beyond == -side && is_equation(i) && stiffness * past > 2 * bears(i);
  if (across)
    put(held, i, false, false, side);
  else
    hold_end(held, i, side > 0);
}

}  // namespace antilock
