#pragma once
#include "antilock/solve/contact_problem.hpp"

namespace antilock {

/// The bounds of C values, and what can be asked of them without a matrix. `upper`, `most`: C entries, or empty.
///
/// Value i is *held* at one of its bounds, where lambda is found, or it is in a *piece* between bounds, where lambda is
/// given: 0 between the two; `most` below a lower bound that gives way, -`most` above an upper one. Every question is
/// the same for contact and for friction: does lambda lie between the pieces beside the bound, does v lie in its piece.
struct ContactBounds {
  struct Interval {
    double low, high;
  };

  const Eigen::VectorXd& lower;
  const Eigen::VectorXd& upper;
  const Eigen::VectorXd& most;

  int count() const { return static_cast<int>(lower.size()); }
  double above(int i) const;  ///< the upper bound of i; infinite: none
  double bears(int i) const;  ///< the most that a bound of i bears; infinite: anything
  /// Whether a piece may have two ends. Lower bounds alone leave room on one side, and never jam a step.
  bool are_narrow() const { return upper.size() > 0 || most.size() > 0; }
  bool is_equation(int i) const { return lower(i) == above(i); }
  /// The bound at which `held` puts i, and the forces that it may bear there.
  double at(const HeldBounds& held, int i) const;
  Interval forces(const HeldBounds& held, int i) const;
  /// The piece in which `held` puts i, and the force that is given there.
  Interval piece(const HeldBounds& held, int i) const;
  double given(const HeldBounds& held, int i) const;
  /// The same of all: 0 where i is held.
  Eigen::VectorXd given(const HeldBounds& held) const;
  /// A start asks for bounds and pieces that there are, and an equation holds unless it gives way.
  HeldBounds allowed(HeldBounds start) const;
  /// The nearest v within the bounds that do not give way, and where it puts every i.
  Eigen::VectorXd nearest(const Eigen::VectorXd& v) const;
  HeldBounds reached(const Eigen::VectorXd& v) const;
  /// The nearest v in the pieces of `held`, at its bounds where it holds.
  Eigen::VectorXd nearest(const HeldBounds& held, Eigen::VectorXd v) const;
  /// From v, pulled by lambda = S v - q: lets go of every bound beside which the energy falls, into that piece.
  HeldBounds downhill(const Eigen::VectorXd& v, const Eigen::VectorXd& lambda) const;
  /// Along v + t direction: the largest t up to 1 at which no v has left its piece, and who is at an end of it then,
  /// -1: nobody. Holds that one there.
  struct Stretch {
    double t = 1;
    int ended = -1;
  };
  Stretch hold_first_end(HeldBounds& held, const Eigen::VectorXd& v, const Eigen::VectorXd& direction) const;
  /// Puts i, at v and pushed by lambda, where its violated condition asks it to be. What would pass through its next
  /// piece, or over its next bound, by itself, with this stiffness, does so at once.
  void exchange(HeldBounds& held, int i, double v, double lambda, double stiffness) const;

 private:
  void put(HeldBounds& held, int i, bool active, bool at_upper, int beyond) const;
  void let_go(HeldBounds& held, int i, bool upwards) const;
  void hold_end(HeldBounds& held, int i, bool high_end) const;
};

/// Whether `held` puts i at its upper bound.
inline bool is_above(const HeldBounds& held, int i) { return !held.above.empty() && held.above[i]; }
/// Beyond which of its bounds `held` puts i: -1, 1, or 0 for none.
inline int is_beyond(const HeldBounds& held, int i) { return held.beyond.empty() ? 0 : held.beyond[i]; }

}  // namespace antilock
