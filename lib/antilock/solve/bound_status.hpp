#pragma once
#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "antilock/core/eigen_memory.hpp"
#include "antilock/core/error.hpp"

namespace antilock {

/// The status of one bound. v is the bounded value, lambda the force that the bound exerts, and g
/// its force limit. The status says on which branch of the set-valued law of the bound the pair (v,
/// lambda) lies (N. Kikuchi and J. T. Oden, Contact Problems in Elasticity, SIAM 1988; contact
/// mechanics calls the branches open, stick and slip):
///
///     slip_below   v <= lower, lambda = +g        the lower bound has reached its force limit
///     at_lower     v = lower,  0 <= lambda <= g   (-g <= lambda if lower = upper: an equation)
///     inactive     lower <= v <= upper, lambda = 0
///     at_upper     v = upper, -g <= lambda <= 0
///     slip_above   v >= upper, lambda = -g        the upper bound has reached its force limit
///
/// In this order v grows and lambda falls. An active bound (at_lower, at_upper) prescribes v, and
/// lambda is the unknown. Every other status prescribes lambda, and v is the unknown.
enum class BoundStatus : signed char { slip_below = -2, at_lower = -1, inactive = 0, at_upper = 1, slip_above = 2 };
using BoundStatuses = std::vector<BoundStatus>;

/// Returns whether the bound prescribes v.
inline bool is_active(BoundStatus status) { return status == BoundStatus::at_lower || status == BoundStatus::at_upper; }

/// C bounds with their set-valued laws. A lower bound, two bounds, an equation and Tresca's
/// friction differ only in the statuses that exist.
struct Bounds {
  Eigen::VectorXd lower;             ///< C; -infinity: no lower bound
  Eigen::VectorXd upper = {};        ///< C, or empty: no upper bounds; +infinity: bound i has none
  Eigen::VectorXd force_limit = {};  ///< C, or empty; the largest |lambda|; +infinity: a hard bound
  /// C, or empty for 0: the multipliers lambda that the earlier corrections have found.
  /// prescribed() and admissible_range() describe lambda - multiplier_estimate, the increment that
  /// a correction solves for.
  Eigen::VectorXd multiplier_estimate = {};

  struct Interval {
    double low, high;
  };

  int count() const { return static_cast<int>(lower.size()); }
  /// Returns the upper bound i, or infinity where there is none.
  double upper_or_infinity(int i) const {
    return upper.size() > 0 ? upper(i) : std::numeric_limits<double>::infinity();
  }
  /// Returns the force limit of bound i, or infinity where it has none.
  double force_limit_or_infinity(int i) const {
    return force_limit.size() > 0 ? force_limit(i) : std::numeric_limits<double>::infinity();
  }
  /// Returns the multiplier estimate of bound i, or 0 where there are none.
  double multiplier_or_zero(int i) const { return multiplier_estimate.size() > 0 ? multiplier_estimate(i) : 0; }
  bool is_equation(int i) const { return lower(i) == upper_or_infinity(i); }

  /// Returns the quantity that `status` prescribes: v where the bound is active, else lambda -
  /// multiplier_estimate.
  double prescribed(int i, BoundStatus status) const {
    if (is_active(status)) return status == BoundStatus::at_lower ? lower(i) : upper(i);
    return total_force(i, status, 0) - multiplier_or_zero(i);
  }

  /// Returns lambda: multiplier_estimate + `reaction` where the bound is active, else the force
  /// that the status prescribes, without round-off.
  double total_force(int i, BoundStatus status, double reaction) const {
    if (is_active(status)) return multiplier_or_zero(i) + reaction;
    if (status == BoundStatus::inactive) return 0;
    return status == BoundStatus::slip_below ? force_limit_or_infinity(i) : -force_limit_or_infinity(i);
  }

  /// Returns the interval in which the quantity that `status` does not prescribe must lie: lambda -
  /// multiplier_estimate where the bound is active, else v.
  Interval admissible_range(int i, BoundStatus status) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    switch (status) {
      case BoundStatus::slip_below:
        return {-infinity, lower(i)};
      case BoundStatus::at_lower:
        return {(is_equation(i) ? -force_limit_or_infinity(i) : 0) - multiplier_or_zero(i),
                force_limit_or_infinity(i) - multiplier_or_zero(i)};
      case BoundStatus::at_upper:
        return {-force_limit_or_infinity(i) - multiplier_or_zero(i), -multiplier_or_zero(i)};
      case BoundStatus::slip_above:
        return {upper_or_infinity(i), infinity};
      default:
        return {lower(i), upper_or_infinity(i)};
    }
  }

  /// Returns the status of bound i that follows `status` towards larger values of v, or smaller
  /// ones where `up` is false. Throws Error where there is none.
  BoundStatus next(int i, BoundStatus status, bool up) const {
    // v grows and lambda falls: a range without an end on that side belongs to the last status
    const auto [low, high] = admissible_range(i, status);
    if (!std::isfinite(is_active(status) == up ? low : high))
      throw Error(fmt::format("contact: the status {} of bound {} is the last one; there is none beyond",
                              static_cast<int>(status), i));
    if (is_equation(i))
      return status != BoundStatus::at_lower ? BoundStatus::at_lower
             : up                            ? BoundStatus::slip_above
                                             : BoundStatus::slip_below;
    return static_cast<BoundStatus>(static_cast<int>(status) + (up ? 1 : -1));
  }

  /// Returns for each bound the existing status that is nearest to the requested one. An equation
  /// is active unless it slips. Throws Error where `requested` has not one entry per bound.
  BoundStatuses nearest_valid(BoundStatuses requested) const {
    if (static_cast<int>(requested.size()) != count())
      throw Error(
          fmt::format("contact: the start has {} statuses; accepted one per bound, {}", requested.size(), count()));
    for (int i = 0; i < count(); ++i) {
      BoundStatus& status = requested[i];
      const bool low = std::isfinite(lower(i)), high = std::isfinite(upper_or_infinity(i)),
                 is_soft = std::isfinite(force_limit_or_infinity(i));
      if (is_soft && ((status == BoundStatus::slip_below && low) || (status == BoundStatus::slip_above && high)))
        continue;
      if (is_equation(i) || (is_active(status) && low && !(status == BoundStatus::at_upper && high)))
        status = BoundStatus::at_lower;
      else
        status = is_active(status) && high ? BoundStatus::at_upper : BoundStatus::inactive;
    }
    return requested;
  }

  /// Returns the same bounds for v - u; u has C entries.
  Bounds shifted_by(const Eigen::VectorXd& u) const {
    return {lower - u, upper.size() > 0 ? Eigen::VectorXd(upper - u) : upper, force_limit, multiplier_estimate};
  }
};

/// Returns a first guess of the status of a bound between two others: their status where they
/// agree, else inactive.
inline BoundStatus common_status(BoundStatus one, BoundStatus other) {
  return one == other ? one : BoundStatus::inactive;
}

}  // namespace antilock
