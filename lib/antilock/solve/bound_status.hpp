#pragma once
#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "antilock/core/error.hpp"
#include "antilock/problem/bounds.hpp"

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
enum class BoundStatus : signed char {
  slip_below = -2,
  at_lower = -1,
  inactive = 0,
  at_upper = 1,
  slip_above = 2
};
using BoundStatuses = std::vector<BoundStatus>;

/// Returns whether the bound prescribes v.
inline bool is_active(BoundStatus status) {
  return status == BoundStatus::at_lower || status == BoundStatus::at_upper;
}

/// C bounds with their set-valued laws, in the form that a correction needs. A correction solves
/// for an increment of v, so the limits are those of this increment. `multiplier_estimate` is
/// subtracted from the forces. A lower bound, two bounds, an equation and Tresca's friction differ
/// only in the statuses that exist.
struct ShiftedBounds : BoundLimits {
  /// C: the multipliers lambda that the earlier corrections have found. prescribed() and
  /// admissible_range() describe lambda - multiplier_estimate.
  Eigen::VectorXd multiplier_estimate;

  struct Interval {
    double low, high;
  };

  /// Makes the bounds of a first correction, whose multiplier estimate is 0. Throws Error unless
  /// all vectors have C entries.
  ShiftedBounds(BoundLimits limits)
      : ShiftedBounds(limits, Eigen::VectorXd::Zero(limits.count())) {}
  ShiftedBounds(BoundLimits limits, Eigen::VectorXd multipliers)
      : BoundLimits(std::move(limits)), multiplier_estimate(std::move(multipliers)) {
    if (upper.size() != count() || force_limit.size() != count() ||
        multiplier_estimate.size() != count())
      throw Error(
          fmt::format("contact: lower, upper, force_limit and multiplier_estimate have {}, {}, {} "
                      "and {} entries; accepted: one "
                      "per bound in each",
                      count(), upper.size(), force_limit.size(), multiplier_estimate.size()));
  }

  /// Returns the quantity that `status` prescribes: v where the bound is active, else lambda -
  /// multiplier_estimate.
  double prescribed(int i, BoundStatus status) const {
    if (is_active(status)) return status == BoundStatus::at_lower ? lower(i) : upper(i);
    return total_force(i, status, 0) - multiplier_estimate(i);
  }

  /// Returns lambda: multiplier_estimate + `reaction` where the bound is active, else the force
  /// that the status prescribes, without round-off.
  double total_force(int i, BoundStatus status, double reaction) const {
    if (is_active(status)) return multiplier_estimate(i) + reaction;
    if (status == BoundStatus::inactive) return 0;
    return status == BoundStatus::slip_below ? force_limit(i) : -force_limit(i);
  }

  /// Returns the interval in which the quantity that `status` does not prescribe must lie: lambda -
  /// multiplier_estimate where the bound is active, else v.
  Interval admissible_range(int i, BoundStatus status) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    switch (status) {
      case BoundStatus::slip_below:
        return {-infinity, lower(i)};
      case BoundStatus::at_lower:
        return {(is_equation(i) ? -force_limit(i) : 0) - multiplier_estimate(i),
                force_limit(i) - multiplier_estimate(i)};
      case BoundStatus::at_upper:
        return {-force_limit(i) - multiplier_estimate(i), -multiplier_estimate(i)};
      case BoundStatus::slip_above:
        return {upper(i), infinity};
      default:
        return {lower(i), upper(i)};
    }
  }

  /// Returns the status of bound i that follows `status` towards larger values of v, or smaller
  /// ones where `up` is false. Throws Error where there is none.
  BoundStatus next(int i, BoundStatus status, bool up) const {
    // From status to status v grows and lambda falls. If the range of `status` has no end in this
    // direction, no status follows.
    const auto [low, high] = admissible_range(i, status);
    if (!std::isfinite(is_active(status) == up ? low : high))
      throw Error(
          fmt::format("contact: the status {} of bound {} is the last one; there is none beyond",
                      static_cast<int>(status), i));
    if (is_equation(i)) {
      if (status != BoundStatus::at_lower) return BoundStatus::at_lower;
      return up ? BoundStatus::slip_above : BoundStatus::slip_below;
    }
    return static_cast<BoundStatus>(static_cast<int>(status) + (up ? 1 : -1));
  }

  /// Returns for each bound the existing status that is nearest to the requested one. An equation
  /// is active unless it slips. Throws Error where `requested` has not one entry per bound.
  BoundStatuses nearest_valid(BoundStatuses requested) const {
    if (static_cast<int>(requested.size()) != count())
      throw Error(fmt::format("contact: the start has {} statuses; accepted one per bound, {}",
                              requested.size(), count()));
    for (int i = 0; i < count(); ++i) {
      BoundStatus& status = requested[i];
      const bool low = std::isfinite(lower(i)), high = std::isfinite(upper(i));
      const bool is_soft = std::isfinite(force_limit(i));
      if (is_soft && ((status == BoundStatus::slip_below && low) ||
                      (status == BoundStatus::slip_above && high)))
        continue;
      if (is_equation(i) ||
          (is_active(status) && low && !(status == BoundStatus::at_upper && high)))
        status = BoundStatus::at_lower;
      else
        status = is_active(status) && high ? BoundStatus::at_upper : BoundStatus::inactive;
    }
    return requested;
  }

  /// Returns the same bounds for v - u; u has C entries.
  ShiftedBounds shifted_by(const Eigen::VectorXd& u) const {
    return {BoundLimits(lower - u, upper - u, force_limit), multiplier_estimate};
  }
};

/// Returns a first guess of the status of a bound between two others: their status where they
/// agree, else inactive.
inline BoundStatus common_status(BoundStatus one, BoundStatus other) {
  return one == other ? one : BoundStatus::inactive;
}

}  // namespace antilock
