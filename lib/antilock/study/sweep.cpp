#include "antilock/study/sweep.hpp"

#include <fmt/format.h>

#include "antilock/core/error.hpp"
#include "antilock/problem/choose_penalty.hpp"

namespace antilock {

Sweep::Sweep(VariationalInequality problem) : problem_(std::move(problem)) { check(problem_); }

void Sweep::set_compliance(double compliance) {
  if (problem_.b.rows() == 0)
    throw Error(
        "sweep: the compliance does not vary where nothing is stiff; accepted: a problem whose B "
        "has rows");
  if (!(compliance >= 0 && compliance <= 1))
    throw Error(fmt::format("sweep: compliance {}; accepted: 0 to 1", compliance));
  problem_.compliance = compliance;
}

void Sweep::set_load(Eigen::VectorXd load) {
  if (load.size() != problem_.size() || !load.allFinite())
    throw Error(
        fmt::format("sweep: a load of {} entries; accepted: {} finite ones, one per unknown",
                    load.size(), problem_.size()));
  problem_.load = std::move(load);
}

void Sweep::set_bounds(Eigen::VectorXd lower, std::optional<Eigen::VectorXd> upper) {
  if (problem_.bounds.unknowns.empty())
    throw Error("sweep: no unknown is bounded; accepted: a problem with contact");
  const BoundLimits before = problem_.bounds.limits();
  problem_.bounds.lower = std::move(lower);
  if (upper) problem_.bounds.upper = std::move(*upper);
  try {
    check_bounds(problem_);
  } catch (const Error&) {
    static_cast<BoundLimits&>(problem_.bounds) = before;
    throw;
  }
}

void Sweep::set_force_limit(Eigen::VectorXd force_limit) {
  std::swap(problem_.bounds.force_limit, force_limit);
  try {
    check_bounds(problem_);
  } catch (const Error&) {
    std::swap(problem_.bounds.force_limit, force_limit);
    throw;
  }
}

const PenalisedCholesky& Sweep::factor() const {
  if (!factor_) throw Error("sweep: no factor before the first answer; accepted: solve first");
  return *factor_;
}

Solution Sweep::solve(ActiveSetOptions options) {
  const double delta = penalty_parameter(problem_, options.penalty);
  const int factorisations_before = factor_ ? factor_->factorisations() : 0;
  if (!factor_)
    factor_.emplace(problem_, delta, options.reduction);
  else if (problem_.b.rows() > 0 && asked_ != delta)  // its own delta may have moved
    factor_->refactor(delta);
  asked_ = delta;
  if (!options.start) options.start = status_;

  Solution solution = active_set(problem_, *factor_, options);
  status_ = solution.status;
  solution.counters.factorisations = factor_->factorisations() - factorisations_before;
  if (solution.counters.factorisations == 0) solution.seconds.factor = 0;
  if (factorisations_before > 0) solution.seconds.analyse = 0;
  total_.unknowns = solution.counters.unknowns;
  total_.factorisations += solution.counters.factorisations;
  total_.solves += solution.counters.solves;
  total_.contact_iterations += solution.counters.contact_iterations;
  total_.corrections += solution.counters.corrections;
  return solution;
}

}  // namespace antilock
