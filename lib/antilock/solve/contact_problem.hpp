#pragma once
#include <Eigen/Core>
#include <vector>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

/// The contact problem condensed on Gamma_C (C unknowns): find v >= lower with
///     lambda = S v - q >= 0  and  lambda (v - lower) = 0,   S symmetric positive definite, dense.
struct ContactProblem {
  const Eigen::MatrixXd& s;      ///< C x C
  const Eigen::VectorXd& q;      ///< C
  const Eigen::VectorXd& lower;  ///< C
  double u_scale;                ///< largest |u| of the whole problem: gaps far below it are round-off
  Eigen::VectorXd from = {};     ///< C, where v and lower count from (empty: 0): round-off is that of from + v
  Eigen::VectorXd noise = {};    ///< C, the round-off of each v where it is known, in place of that of u_scale
};

struct ContactAnswer {
  Eigen::VectorXd v, lambda;  ///< C each
  std::vector<bool> active;   ///< C: v = lower
  int steps = 0;              ///< linear systems solved
};

/// Primal-dual active set from a given start. Where the number of violated conditions stops falling, projected Newton
/// steps (Bertsekas 1982) propose the sets: they lower the energy, so nothing can cycle. Throws NotConverged after
/// max_steps linear systems.
ContactAnswer solve_contact(const ContactProblem& problem, std::vector<bool> active, int max_steps);

/// A start for solve_contact that makes its steps independent of h: the same problem, bounded on every second unknown
/// only (the others are free and eliminated), solved the same way down to a handful, gives the contact set by
/// interpolation. Elimination keeps every order of S right; interpolated functions (P' S P) would be far too stiff for
/// a beam, whose bending energy does not take their corners.
std::vector<bool> nested_start(const ContactProblem& problem, int max_steps);

}  // namespace antilock
