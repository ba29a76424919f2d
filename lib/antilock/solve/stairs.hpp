#pragma once
#include <Eigen/Core>
#include <vector>

#include "antilock/core/detail/eigen_memory.hpp"

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
inline bool is_held(Piece piece) { return piece == Piece::at_lower || piece == Piece::at_upper; }

/// C stairs. A bound from below, two bounds, an equation, friction: each is a list of the pieces above that it has.
struct Stairs {
  Eigen::VectorXd lower;       ///< C; -infinity: none
  Eigen::VectorXd upper = {};  ///< C, or empty: none; +infinity: none here
  Eigen::VectorXd bears = {};  ///< C, or empty: the most that a bound bears; +infinity: anything
  Eigen::VectorXd force = {};  ///< C, or empty: the lambda so far, from which the given and found ones count

  struct Interval {
    double low, high;
  };

  int count() const { return static_cast<int>(lower.size()); }
  double above(int i) const;  ///< the upper bound of i; infinite: none
  double most(int i) const;   ///< what bound i bears; infinite: anything
  bool is_equation(int i) const { return lower(i) == above(i); }
  /// What `piece` gives: v where it holds, else lambda - force.
  double given(int i, Piece piece) const;
  /// lambda, of which `found` counts from the force so far; where it is given, so to the last digit.
  double whole_force(int i, Piece piece, double found) const;
  /// Where the other one of v and lambda - force must lie.
  Interval found(int i, Piece piece) const;
  /// The next piece of stair i towards larger values, or towards smaller ones. Throws Error where there is none.
  Piece next(int i, Piece piece, bool up) const;
  /// The pieces that there are, nearest to those asked for; an equation holds unless it gives way. Throws Error where
  /// `asked` has not one entry per stair.
  Pieces there_are(Pieces asked) const;
  double so_far(int i) const { return force.size() > 0 ? force(i) : 0; }  ///< lambda of i so far
  /// The same stairs for v - u, or of some of the bounds.
  Stairs from(const Eigen::VectorXd& u) const;
  Stairs of(const std::vector<int>& bounds) const;
};

/// The piece of a bound between two others: theirs where they agree, else between.
inline Piece agreed(Piece one, Piece other) { return one == other ? one : Piece::between; }

}  // namespace antilock
