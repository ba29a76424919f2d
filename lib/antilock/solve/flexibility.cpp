#include "antilock/solve/flexibility.hpp"

namespace antilock {

LinearResponse::LinearResponse(const VariationalInequality& problem, PenalisedCholesky& factor,
                               const CorrectionOptions& corrections)
    : problem_(problem), linear_(problem), factor_(factor) {
  options_.corrections = corrections;
  linear_.bounds = {};
  homogeneous_ = linear_;
  homogeneous_.dirichlet_values.setZero();
}

Solution LinearResponse::solve(const Eigen::VectorXd& lambda) {
  linear_.load = problem_.load + bound_forces(problem_.bounds, lambda, problem_.size());
  return active_set(linear_, factor_, options_);
}

Flexibility LinearResponse::flexibility() {
  const int count = problem_.bounds.count();
  Flexibility result;
  result.free = solve(Eigen::VectorXd::Zero(count));
  result.w = bounded_values(problem_.bounds, result.free.u);
  result.f.resize(count, count);
  result.unlocked.resize(count);
  for (int i = 0; i < count; ++i) {
    homogeneous_.load =
        bound_forces(problem_.bounds, Eigen::VectorXd::Unit(count, i), problem_.size());
    const Solution moved = active_set(homogeneous_, factor_, options_);
    result.f.col(i) = bounded_values(problem_.bounds, moved.u);
    result.unlocked(i) = moved.penalised_max_u;
  }
  result.f = (0.5 * (result.f + result.f.transpose())).eval();  // symmetric but for round-off
  return result;
}

}  // namespace antilock
