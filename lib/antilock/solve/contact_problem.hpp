#pragma once
#include <Eigen/Dense>
#include <vector>

namespace antilock {

/// The contact problem condensed on Gamma_C (C unknowns): find v >= lower with
///     lambda = S v - q >= 0  and  lambda (v - lower) = 0,   S symmetric positive definite, dense.
struct ContactProblem {
  const Eigen::MatrixXd& s;      ///< C x C
  const Eigen::VectorXd& q;      ///< C
  const Eigen::VectorXd& lower;  ///< C
  double u_scale;                ///< largest |u| of the whole problem: gaps far below it are round-off
};

struct ContactAnswer {
  Eigen::VectorXd v, lambda;  ///< C each
  std::vector<bool> active;   ///< C: v = lower
  int steps = 0;              ///< linear systems solved
};

/// Primal-dual active set from a given start. Where the number of violated conditions stops falling, projected Newton steps
/// (Bertsekas 1982) propose the sets: they lower the energy, so nothing can cycle.
/// Throws NotConverged after max_steps linear systems.
ContactAnswer solve_contact(const ContactProblem& problem, std::vector<bool> active, int max_steps);

/// A start for solve_contact that makes its steps independent of h: the same problem on every second unknown
/// (P' S P, P linear interpolation), solved the same way down to a handful, gives the contact set by interpolation.
std::vector<bool> nested_start(const ContactProblem& problem, int max_steps);

}  // namespace antilock
