#include "antilock/solve/sparse_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/solve/aggregation.hpp"
#include "antilock/solve/contact_loop.hpp"
#include "antilock/solve/projected_newton.hpp"

namespace antilock {
namespace {

constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();

/// The road of `settle` on all F places, by a sparse factor of those that are not held.
class SparseRoad {
 public:
  SparseRoad(const SparseContactProblem& p, HeldBounds start)
      : p_(p),
        bounds_{p.lower, p.upper, p.most},
        from_(p.from.size() > 0 ? p.from : Eigen::VectorXd::Zero(p.q.size())),
        diagonal_(p.k.upper().diagonal()),
        held_(bounds_.allowed(std::move(start))) {}

  int count() const { return bounds_.count(); }
  int steps() const { return steps_; }
  SparseContactAnswer answer() const {
    return {{bounded(x_), lambda_, held_.active, steps_, held_.above, held_.beyond}, x_};
  }

  /// x on the unknowns that are not held from the equation, at its bound on the held ones; lambda from both.
  void solve() {
    std::vector<char> held(p_.q.size(), 0);
    x_.setZero(p_.q.size());
    for (int i = 0; i < count(); ++i)
      if (held_.active[i]) {
        held[p_.bounded[i]] = 1;
        x_(p_.bounded[i]) = bounds_.at(held_, i);
      }
    p_.k.hold(held);
    const Eigen::VectorXd given = bounds_.given(held_);
    Eigen::VectorXd q = p_.q;
    q(p_.bounded) += given;
    x_ += p_.k.solve(q - p_.k.times(x_));
    lambda_ = bounded(p_.k.times(x_) - p_.q);
    for (int i = 0; i < count(); ++i)
      if (!held_.active[i]) lambda_(i) = given(i);
    // the same measures of round-off as on the dense road: see there
    const Eigen::VectorXd size = (from_ + x_).cwiseAbs();
    Eigen::VectorXd pushed = Eigen::VectorXd::Zero(x_.size());
    for (int i = 0; i < count(); ++i) {
      const int place = p_.bounded[i];
      pushed(place) = round_off * (diagonal_(place) * size(place) + std::abs(p_.q(place)) + std::abs(given(i)));
    }
    moved_ = bounded(p_.k.solve(pushed)).cwiseAbs();
    noise_lambda_ = round_off * (bounded(p_.k.absolute_times(size) + p_.q.cwiseAbs()) + given.cwiseAbs());
    ++steps_;
  }

  /// By more than noise.
  bool violated(int i) const {
    if (held_.active[i]) {
      const auto [low, high] = bounds_.forces(held_, i);
      return lambda_(i) - low < -noise_lambda_(i) || high - lambda_(i) < -noise_lambda_(i);
    }
    const double x = x_(p_.bounded[i]);
    const auto [low, high] = bounds_.piece(held_, i);
    return x - low < -noise_at(i, low) || high - x < -noise_at(i, high);
  }

  void exchange(int i) { bounds_.exchange(held_, i, x_(p_.bounded[i]), lambda_(i), diagonal_(p_.bounded[i])); }

  void descend() {
    if (descent_.size() == 0) {
      descent_ = x_;
      descent_(p_.bounded) = bounds_.nearest(bounded(x_));
    }
    held_ = projected_newton_step(*this, descent_);
  }

  // of the projected Newton step
  Eigen::VectorXd times(const Eigen::VectorXd& x) const { return p_.k.times(x); }
  const Eigen::VectorXd& load() const { return p_.q; }
  const std::vector<int>& places() const { return p_.bounded; }
  const ContactBounds& bounds() const { return bounds_; }
  Eigen::VectorXd newton(const HeldBounds& pieces, const Eigen::VectorXd& gradient) {
    std::vector<char> held(gradient.size(), 0);
    for (int i = 0; i < count(); ++i) held[p_.bounded[i]] = pieces.active[i] ? 1 : 0;
    p_.k.hold(held);
    ++steps_;
    return p_.k.solve(-gradient);
  }

 private:
  Eigen::VectorXd bounded(const Eigen::VectorXd& x) const { return x(p_.bounded); }

  /// Round-off of x beside a bound. Where it is known, nothing is added to it: a diagonal entry of K, unlike one of a
  /// Schur complement, holds the penalty, and what it makes of round-off may hide a violation.
  double noise_at(int i, double bound) const {
    const double place = std::abs(from_(p_.bounded[i]) + bound);
    return (p_.noise.size() > 0 ? round_off * place + p_.noise(i) : round_off * std::max(place, p_.u_scale)) + moved_(i);
  }

  const SparseContactProblem& p_;
  const ContactBounds bounds_;
  Eigen::VectorXd from_, diagonal_;  ///< F each
  HeldBounds held_;
  Eigen::VectorXd x_;                     ///< F
  Eigen::VectorXd lambda_;                ///< C
  Eigen::VectorXd moved_, noise_lambda_;  ///< C each, what round-off makes of x and of lambda
  Eigen::VectorXd descent_;               ///< F, the feasible x of the projected Newton steps; empty: none so far
  int steps_ = 0;
};

/// The mean of the bounds of the members of each coarse unknown; infinite where one of them is.
Eigen::VectorXd mean_bound(const Eigen::VectorXd& bound, const std::vector<int>& coarse_of, Eigen::Index coarse) {
  if (bound.size() == 0) return {};
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(coarse), members = sum;
  for (Eigen::Index i = 0; i < bound.size(); ++i) {
    sum(coarse_of[i]) += bound(i);
    ++members(coarse_of[i]);
  }
  return sum.cwiseQuotient(members);
}

/// What the members of each coarse unknown bear together; infinite where one of them bears anything.
Eigen::VectorXd sum_of_most(const Eigen::VectorXd& most, const std::vector<int>& coarse_of, Eigen::Index coarse) {
  if (most.size() == 0) return {};
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(coarse);
  for (Eigen::Index i = 0; i < most.size(); ++i) sum(coarse_of[i]) += most(i);
  return sum;
}

}  // namespace

SparseContactAnswer solve_contact(const SparseContactProblem& problem, HeldBounds start, int max_steps) {
  SparseRoad road(problem, std::move(start));
  settle(road, max_steps);
  return road.answer();
}

HeldBounds nested_start(const SparseContactProblem& problem, int max_steps) {
  constexpr Eigen::Index few = 300;
  const std::size_t count = problem.bounded.size();
  HeldBounds none(std::vector<bool>(count, false));
  if (problem.q.size() <= few) return none;
  Aggregates aggregates = smoothed_aggregation(problem.k.upper());
  const SparseMatrix& p = aggregates.prolongation;
  if (3 * p.cols() > 2 * p.rows()) return none;  // nothing to aggregate

  std::vector<int> bounded, bound_of(p.cols(), -1), coarse_of;  // aggregate -> its bound, bound -> coarse bound
  for (const int place : problem.bounded) {
    int& bound = bound_of[aggregates.of[place]];
    if (bound < 0) {
      bound = static_cast<int>(bounded.size());
      bounded.push_back(aggregates.of[place]);
    }
    coarse_of.push_back(bound);
  }
  const auto coarse_count = static_cast<Eigen::Index>(bounded.size());
  const Eigen::VectorXd lower = mean_bound(problem.lower, coarse_of, coarse_count), q = p.transpose() * problem.q;
  HeldFactor k;
  ContactAnswer answer;
  try {
    if (k.factorise(std::move(aggregates.coarse))) return none;
    SparseContactProblem coarse{k, q, bounded, lower, problem.u_scale};
    coarse.upper = mean_bound(problem.upper, coarse_of, coarse_count);
    coarse.most = sum_of_most(problem.most, coarse_of, coarse_count);
    answer = solve_contact(coarse, nested_start(coarse, max_steps), max_steps).contact;
  } catch (const Error&) {
    return none;  // a start, no more: the fine problem says what is wrong
  }
  HeldBounds start(std::vector<bool>(count), std::vector<bool>(problem.upper.size()),
                   std::vector<int>(problem.most.size()));
  const RowMatrix rows = p;
  for (std::size_t i = 0; i < count; ++i) {
    const bool above = !answer.above.empty() && answer.above[coarse_of[i]];
    bool active = true;
    for (RowMatrix::InnerIterator w(rows, problem.bounded[i]); w; ++w) {
      const int bound = bound_of[w.col()];
      active = active && bound >= 0 && answer.active[bound] && (answer.above.empty() || answer.above[bound] == above);
    }
    start.active[i] = active;
    if (problem.upper.size() > 0) start.above[i] = active && above;
    if (problem.most.size() > 0) start.beyond[i] = answer.beyond[coarse_of[i]];
  }
  return start;
}

}  // namespace antilock
