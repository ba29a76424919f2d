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
enum class Piece : signed char { below = -2, at_lower = -1, between = 0, at_upper = 1, above = 2 };
using Pieces = std::vector<Piece>;

/// Whether v is given there.
inline bool is_active(Piece piece) { return piece == Piece::at_lower || piece == Piece::at_upper; }

/// C stairs. A bound from below, two bounds, an equation, friction: each is a list of the pieces above that it has.
struct Stairs {
  Eigen::VectorXd lower;       ///< C; -infinity: none
  Eigen::VectorXd upper = {};  ///< C, or empty: none; +infinity: none here
  Eigen::VectorXd bears = {};  ///< C, or empty: the most that a bound bears; +infinity: anything
  Eigen::VectorXd force = {};  ///< C, or empty: lambda of the corrections so far; `given` and `found` are without it

  struct Interval {
    double low, high;
  };

  int count() const { return static_cast<int>(lower.size()); }
  /// The upper bound of i, what it bears (both infinite: none), and its lambda so far.
  double above(int i) const { return upper.size() > 0 ? upper(i) : std::numeric_limits<double>::infinity(); }
  double most(int i) const { return bears.size() > 0 ? bears(i) : std::numeric_limits<double>::infinity(); }
  double so_far(int i) const { return force.size() > 0 ? force(i) : 0; }
  bool is_equation(int i) const { return lower(i) == above(i); }

  /// What `piece` gives: v where it holds, else lambda - force.
  double given(int i, Piece piece) const {
    if (is_active(piece)) return piece == Piece::at_lower ? lower(i) : upper(i);
    return whole_force(i, piece, 0) - so_far(i);
  }

  /// The whole lambda: the force so far and `found` where v is held, else what the piece gives, to the last digit.
  double whole_force(int i, Piece piece, double found) const {
    if (is_active(piece)) return so_far(i) + found;
    return piece == Piece::below ? most(i) : piece == Piece::above ? -most(i) : 0;
  }

  /// Where the other one of v and lambda - force must lie.
  Interval found(int i, Piece piece) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    switch (piece) {
      case Piece::below:
        return {-infinity, lower(i)};
      case Piece::at_lower:
        return {(is_equation(i) ? -most(i) : 0) - so_far(i), most(i) - so_far(i)};
      case Piece::at_upper:
        return {-most(i) - so_far(i), -so_far(i)};
      case Piece::above:
        return {above(i), infinity};
      default:
        return {lower(i), above(i)};
    }
  }

  /// The next piece of stair i towards larger values, or towards smaller ones. Throws Error where there is none.
  Piece next(int i, Piece piece, bool up) const {
    // v rises and lambda falls: a piece without an end that way is the last one
    const auto [low, high] = found(i, piece);
    if (!std::isfinite(is_active(piece) == up ? low : high))
      throw Error(
          fmt::format("contact: stair {} ends with piece {}; there is none beyond", i, static_cast<int>(piece)));
    if (is_equation(i)) return piece != Piece::at_lower ? Piece::at_lower : up ? Piece::above : Piece::below;
    return static_cast<Piece>(static_cast<int>(piece) + (up ? 1 : -1));
  }

  /// The pieces that there are, nearest to those asked for; an equation holds unless it gives way. Throws Error where
  /// `asked` has not one entry per stair.
  Pieces there_are(Pieces asked) const {
    if (static_cast<int>(asked.size()) != count())
      throw Error(fmt::format("contact: the start has {} pieces; accepted one per bound, {}", asked.size(), count()));
    for (int i = 0; i < count(); ++i) {
      Piece& piece = asked[i];
      const bool low = std::isfinite(lower(i)), high = std::isfinite(above(i)), gives_way = std::isfinite(most(i));
      if (gives_way && ((piece == Piece::below && low) || (piece == Piece::above && high))) continue;
      if (is_equation(i) || (is_active(piece) && low && !(piece == Piece::at_upper && high)))
        piece = Piece::at_lower;
      else
        piece = is_active(piece) && high ? Piece::at_upper : Piece::between;
    }
    return asked;
  }

  /// The same stairs for v - u.
  Stairs from(const Eigen::VectorXd& u) const {
    return {lower - u, upper.size() > 0 ? Eigen::VectorXd(upper - u) : upper, bears, force};
  }
};

/// The piece of a bound between two others: theirs where they agree, else between.
inline Piece agreed(Piece one, Piece other) { return one == other ? one : Piece::between; }

}  // namespace antilock
