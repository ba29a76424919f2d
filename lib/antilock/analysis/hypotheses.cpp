#include "antilock/analysis/hypotheses.hpp"

#include <cmath>
#include <limits>

#include "antilock/analysis/kernel.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {

Hypotheses check_hypotheses(const VariationalInequality& problem, const SparseMatrix& norm) {
  Hypotheses found;
  found.coercivity = coercivity(problem, norm);
  found.kernel = kernel_dimension(problem);
  found.free = problem.free_count();
  // a singular a1 + a0 has no solution to ask: (H1) has failed already
  found.distance =
      found.coercive() ? distance_to_kernel(problem) : std::numeric_limits<double>::quiet_NaN();
  return found;
}

double distance_to_kernel(const VariationalInequality& problem) {
  if (problem.b.rows() == 0) return 0;
  // Without a load, u minimises a1/2 + a0/(2 epsilon) over K_h: as epsilon -> 0, a0 tends to its
  // smallest value there.
  VariationalInequality unloaded = assemble_fixed_rows(problem);
  unloaded.load.setZero();
  for (double& g : unloaded.bounds.force_limit)  // what gives way is no part of K_h
    if (std::isfinite(g)) g = 0;
  unloaded.compliance = 1e-9 * stiffness_ratio(unloaded).value();
  const Solution s = active_set(unloaded);
  const double u = s.u.lpNorm<Eigen::Infinity>();
  const Eigen::VectorXd unit =
      unloaded.b.cwiseAbs() * Eigen::VectorXd::Ones(problem.size());  // of a row, for |u| = 1
  const Eigen::VectorXd strain =
      (unloaded.b * s.u).cwiseQuotient(unit.cwiseMax(std::numeric_limits<double>::min()));
  return u > 0 ? strain.lpNorm<Eigen::Infinity>() / u : 0;
}

}  // namespace antilock
