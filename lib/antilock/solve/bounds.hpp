#pragma once
#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "antilock/core/eigen_memory.hpp"
#include "antilock/core/error.hpp"

namespace antilock {

/// On which piece of its stair a bounded value v stands, lambda the force of the bound on it:
///
///     below      v <= lower, lambda = +bears        the bound from below gives way
///     at_lower   v = lower,  0 <= lambda <= bears   (of either sign where lower = upper: an equation)
///     between    lower <= v <= upper, lambda = 0
///     at_upper   v = upper, -bears <= lambda <= 0
///     above      v >= upper, lambda = -bears        the bound from above gives way
///
/// Along the stair, from below to above, v rises and lambda falls. On every second piece v is given and lambda is
/// found; on the others it is the other way round.
enum class BoundStatus : signed char { slip_below = -2, at_lower = -1, inactive = 0, at_upper = 1, slip_above = 2 };
using BoundStatuses = std::vector<BoundStatus>;

/// Whether v is given there.
inline bool is_active(BoundStatus status) { return status == BoundStatus::at_lower || status == BoundStatus::at_upper; }

/// C stairs. A bound from below, two bounds, an equation, friction: each is a list of the pieces above that it has.
struct Bounds {
  Eigen::VectorXd lower;             ///< C; -infinity: none
  Eigen::VectorXd upper = {};        ///< C, or empty: none; +infinity: none here
  Eigen::VectorXd force_limit = {};  ///< C, or empty: the most that a bound bears; +infinity: anything
  Eigen::VectorXd accumulated_force =
      {};  ///< C, or empty: lambda of the corrections so far; `prescribed` and `admissible_range` are without it

  struct Interval {
    double low, high;
  };

  int count() const { return static_cast<int>(lower.size()); }
  /// The upper bound of i, what it bears (both infinite: none), and its lambda so far.
  double upper_or_infinity(int i) const {
    return upper.size() > 0 ? upper(i) : std::numeric_limits<double>::infinity();
  }
  double force_limit_or_infinity(int i) const {
    return force_limit.size() > 0 ? force_limit(i) : std::numeric_limits<double>::infinity();
  }
  double accumulated(int i) const { return accumulated_force.size() > 0 ? accumulated_force(i) : 0; }
  bool is_equation(int i) const { return lower(i) == upper_or_infinity(i); }

  /// What `status` gives: v where it holds, else lambda - force.
  double prescribed(int i, BoundStatus status) const {
    if (is_active(status)) return status == BoundStatus::at_lower ? lower(i) : upper(i);
    return total_force(i, status, 0) - accumulated(i);
  }

  /// The whole lambda: the force so far and `admissible_range` where v is held, else what the piece gives, to the last
  /// digit.
  double total_force(int i, BoundStatus status, double reaction) const {
    if (is_active(status)) return accumulated(i) + reaction;
    return status == BoundStatus::slip_below   ? force_limit_or_infinity(i)
           : status == BoundStatus::slip_above ? -force_limit_or_infinity(i)
                                               : 0;
  }

  /// Where the other one of v and lambda - force must lie.
  Interval admissible_range(int i, BoundStatus status) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    switch (status) {
      case BoundStatus::slip_below:
        return {-infinity, lower(i)};
      case BoundStatus::at_lower:
        return {(is_equation(i) ? -force_limit_or_infinity(i) : 0) - accumulated(i),
                force_limit_or_infinity(i) - accumulated(i)};
      case BoundStatus::at_upper:
        return {-force_limit_or_infinity(i) - accumulated(i), -accumulated(i)};
      case BoundStatus::slip_above:
        return {upper_or_infinity(i), infinity};
      default:
        return {lower(i), upper_or_infinity(i)};
    }
  }

  /// The next piece of stair i towards larger values, or towards smaller ones. Throws Error where there is none.
  BoundStatus next(int i, BoundStatus status, bool up) const {
    // v rises and lambda falls: a piece without an end that way is the last one
    const auto [low, high] = admissible_range(i, status);
    if (!std::isfinite(is_active(status) == up ? low : high))
      throw Error(
          fmt::format("contact: stair {} ends with piece {}; there is none beyond", i, static_cast<int>(status)));
    if (is_equation(i))
      return status != BoundStatus::at_lower ? BoundStatus::at_lower
             : up                            ? BoundStatus::slip_above
                                             : BoundStatus::slip_below;
    return static_cast<BoundStatus>(static_cast<int>(status) + (up ? 1 : -1));
  }

  /// The pieces that there are, nearest to those asked for; an equation holds unless it gives way. Throws Error where
  /// `requested` has not one entry per stair.
  BoundStatuses nearest_valid(BoundStatuses requested) const {
    if (static_cast<int>(requested.size()) != count())
      throw Error(
          fmt::format("contact: the start has {} pieces; accepted one per bound, {}", requested.size(), count()));
    for (int i = 0; i < count(); ++i) {
      BoundStatus& status = requested[i];
      const bool low = std::isfinite(lower(i)), high = std::isfinite(upper_or_infinity(i)),
                 gives_way = std::isfinite(force_limit_or_infinity(i));
      if (gives_way && ((status == BoundStatus::slip_below && low) || (status == BoundStatus::slip_above && high)))
        continue;
      if (is_equation(i) || (is_active(status) && low && !(status == BoundStatus::at_upper && high)))
        status = BoundStatus::at_lower;
      else
        status = is_active(status) && high ? BoundStatus::at_upper : BoundStatus::inactive;
    }
    return requested;
  }

  /// The same stairs for v - u.
  Bounds shifted_by(const Eigen::VectorXd& u) const {
    return {lower - u, upper.size() > 0 ? Eigen::VectorXd(upper - u) : upper, force_limit, accumulated_force};
  }
};

/// The piece of a bound between two others: theirs where they agree, else between.
inline BoundStatus common_status(BoundStatus one, BoundStatus other) {
  return one == other ? one : BoundStatus::inactive;
}

}  // namespace antilock
