#pragma once
#include <Eigen/Core>
#include <vector>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

/// The contact problem condensed on Gamma_C (C unknowns): find lower <= v <= upper with lambda = S v - q
///     >= 0 where v = lower,  <= 0 where v = upper,  = 0 between,   S symmetric positive definite, dense.
/// A bound that bears `most` gives way: lambda = most and v <= lower, or lambda = -most and v >= upper.
struct ContactProblem {
  const Eigen::MatrixXd& s;      ///< C x C
  const Eigen::VectorXd& q;      ///< C
  const Eigen::VectorXd& lower;  ///< C; -infinity: none
  double u_scale;                ///< largest |u| of the whole problem: gaps far below it are round-off
  Eigen::VectorXd from = {};     ///< C, where v and lower count from (empty: 0): round-off is that of from + v
  Eigen::VectorXd noise = {};    ///< C, the round-off of each v where it is known, in place of that of u_scale
  Eigen::VectorXd upper = {};    ///< C, or empty: none; +infinity: none here
  Eigen::VectorXd most = {};     ///< C, or empty: the most that a bound bears; +infinity: anything
};

/// Which bounds hold.
struct HeldBounds {
  HeldBounds() = default;
  HeldBounds(std::vector<bool> active, std::vector<bool> above = {}, std::vector<int> beyond = {})
      : active(std::move(active)), above(std::move(above)), beyond(std::move(beyond)) {}
  std::vector<bool> active;  ///< C: at the lower bound, or at the upper one
  std::vector<bool> above;   ///< C, or empty (nowhere): of these, the ones at the upper bound
  std::vector<int> beyond;  ///< C, or empty (nowhere): of the others, -1 below a lower bound that gives way, 1 above an
                            ///< upper one
};

struct ContactAnswer {
  Eigen::VectorXd v, lambda;  ///< C each
  std::vector<bool> active;   ///< C: v is at a bound
  int steps = 0;              ///< linear systems solved
  std::vector<bool> above;    ///< C, or empty where nothing has an upper bound: v = upper
  std::vector<int> beyond;    ///< C, or empty where no bound gives way: as in HeldBounds
};

/// The bounds that an answer holds: a start for the next problem.
inline HeldBounds held_by(const ContactAnswer& answer) { return {answer.active, answer.above, answer.beyond}; }

/// Primal-dual active set from a given start. Where the number of violated conditions stops falling, projected Newton
/// steps (Bertsekas 1982) propose the sets: they lower the energy, so nothing can cycle. A start on the wrong side of a
/// two-sided bound costs a step. Throws NotConverged after max_steps linear systems.
ContactAnswer solve_contact(const ContactProblem& problem, HeldBounds start, int max_steps);

/// A start for solve_contact that makes its steps independent of h: the same problem, bounded on every second unknown
/// only (the others are free and eliminated), solved the same way down to a handful, gives the contact set by
/// interpolation. Elimination keeps every order of S right; interpolated functions (P' S P) would be far too stiff for
/// a beam, whose bending energy does not take their corners.
HeldBounds nested_start(const ContactProblem& problem, int max_steps);

}  // namespace antilock
