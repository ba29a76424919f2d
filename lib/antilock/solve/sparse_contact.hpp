#pragma once
#include <vector>

#include "antilock/solve/contact_problem.hpp"
#include "antilock/solve/held_factor.hpp"

namespace antilock {

/// The contact problem on all F places, for many bounds: find x with lower <= x <= upper on the bounded places and
///     lambda = K x - q >= 0 where x = lower,  <= 0 where x = upper,  = 0 between and on all other places.
/// Bounds give way as in the dense one.
struct SparseContactProblem {
  HeldFactor& k;
  const Eigen::VectorXd& q;         ///< F
  const std::vector<int>& bounded;  ///< C places
  const Eigen::VectorXd& lower;     ///< C; -infinity: none
  double u_scale;                   ///< largest |u| of the whole problem: gaps far below it are round-off
  Eigen::VectorXd from = {};        ///< F, where x and lower count from (empty: 0): round-off is that of from + x
  Eigen::VectorXd noise = {};       ///< C, the round-off of each bounded x where it is known
  Eigen::VectorXd upper = {};       ///< C, or empty: none; +infinity: none here
  Eigen::VectorXd most = {};        ///< C, or empty: the most that a bound bears; +infinity: anything
};

struct SparseContactAnswer {
  ContactAnswer contact;  ///< v and lambda on the bounded places
  Eigen::VectorXd x;      ///< F
};

/// As the dense one (contact_problem.hpp), with the same questions and the same safeguard. Throws NotConverged.
SparseContactAnswer solve_contact(const SparseContactProblem& problem, HeldBounds start, int max_steps);

/// A start that needs no mesh: K is coarsened by smoothed aggregation (Vanek, Mandel, Brezina 1996), the same problem
/// solved there, in the same way down to a few hundred unknowns, and an unknown starts in contact where every coarse one
/// that it depends on is. Rather too small a set than too large: a hole in it is filled in a step or two, what is too
/// much is given up one row of cells at a time. Where aggregation does not fit K (a beam) the start is merely a poor one.
HeldBounds nested_start(const SparseContactProblem& problem, int max_steps);

}  // namespace antilock
