#include "antilock/solve/sparse_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/solve/aggregation.hpp"

namespace antilock {
namespace {

constexpr double unit = 64 * std::numeric_limits<double>::epsilon();

/// The primal-dual active set of one problem: the steps of the dense road, each on all F places.
class Iteration {
 public:
  Iteration(const SparseContactProblem& p, HeldBounds start)
      : p_(p),
        from_(p.from.size() > 0 ? p.from : Eigen::VectorXd::Zero(p.q.size())),
        diagonal_(p.k.upper().diagonal()) {
    held_.active = std::move(start.active);
    held_.above = std::move(start.above);
    held_.above.resize(p.upper.size());
    for (int i = 0; i < count(); ++i) {  // a start asks for bounds that there are; an equation always holds
      if (is_equation(i)) held_.active[i] = true;
      const bool low = std::isfinite(p.lower(i)), high = std::isfinite(upper(i));
      if (p.upper.size() > 0) held_.above[i] = held_.active[i] && high && (held_.above[i] || !low);
    }
  }

  SparseContactAnswer run(int max_steps) {
    int fewest = count() + 1;
    int patience = 5;  // exchanges of whole sets allowed without progress before the energy is asked
    while (true) {
      solve();
      std::vector<int> wrong;
      for (int i = 0; i < count(); ++i)
        if (violated(i)) wrong.push_back(i);
      const int violations = static_cast<int>(wrong.size());
      if (violations == 0) return {{bounded(x_), std::move(lambda_), held_.active, steps_, held_.above}, std::move(x_)};
      if (steps_ >= max_steps)
        throw NotConverged(fmt::format("contact: {} of {} contact conditions still violated after {} steps", violations,
                                       count(), steps_),
                           static_cast<double>(violations) / count(), steps_);
      patience = violations < fewest ? 5 : patience - 1;
      fewest = std::min(fewest, violations);
      if (patience > 0)
        for (const int i : wrong) exchange(i);
      else
        descend();
    }
  }

 private:
  int count() const { return static_cast<int>(p_.bounded.size()); }
  double upper(int i) const { return p_.upper.size() > 0 ? p_.upper(i) : std::numeric_limits<double>::infinity(); }
  bool is_equation(int i) const { return p_.lower(i) == upper(i); }
  bool is_above(int i) const { return !held_.above.empty() && held_.above[i]; }
  Eigen::VectorXd bounded(const Eigen::VectorXd& x) const { return x(p_.bounded); }

  /// x on the unknowns that are not held from the equation, at its bound on the held ones; lambda from both.
  void solve() {
    std::vector<char> held(p_.q.size(), 0);
    x_.setZero(p_.q.size());
    for (int i = 0; i < count(); ++i)
      if (held_.active[i]) {
        held[p_.bounded[i]] = 1;
        x_(p_.bounded[i]) = is_above(i) ? p_.upper(i) : p_.lower(i);
      }
    p_.k.hold(held);
    x_ += p_.k.solve(p_.q - p_.k.times(x_));
    lambda_ = bounded(p_.k.times(x_) - p_.q);
    for (int i = 0; i < count(); ++i)
      if (!held_.active[i]) lambda_(i) = 0;
    // the same measures of round-off as on the dense road: see there
    const Eigen::VectorXd size = (from_ + x_).cwiseAbs();
    Eigen::VectorXd pushed = Eigen::VectorXd::Zero(x_.size());
    for (const int place : p_.bounded) pushed(place) = unit * (diagonal_(place) * size(place) + std::abs(p_.q(place)));
    moved_ = bounded(p_.k.solve(pushed)).cwiseAbs();
    noise_lambda_ = unit * bounded(p_.k.absolute_times(size) + p_.q.cwiseAbs());
    ++steps_;
  }

  /// Round-off of x beside a bound. Where it is known, nothing is added to it: a diagonal entry of K, unlike one of a
  /// Schur complement, holds the penalty, and what it makes of round-off may hide a violation.
  double noise_at(int i, double bound) const {
    const double place = std::abs(from_(p_.bounded[i]) + bound);
    return p_.noise.size() > 0 ? unit * place + p_.noise(i) : unit * std::max(place, p_.u_scale) + moved_(i);
  }

  /// Whether bound i is on the wrong side by more than noise. An equation holds whatever its force.
  bool violated(int i) const {
    const double x = x_(p_.bounded[i]);
    if (!held_.active[i]) return x - p_.lower(i) < -noise_at(i, p_.lower(i)) || upper(i) - x < -noise_at(i, upper(i));
    return (is_above(i) ? -lambda_(i) : lambda_(i)) < -noise_lambda_(i) && !is_equation(i);
  }

  /// Puts i where its violated condition asks it to be. An unknown that is let go and, alone, would reach its other bound
  /// goes there at once.
  void exchange(int i) {
    const bool active = held_.active[i];
    const bool across = active && diagonal_(p_.bounded[i]) * (upper(i) - p_.lower(i)) < std::abs(lambda_(i));
    const bool above = active ? across && !is_above(i) : x_(p_.bounded[i]) > upper(i);
    held_.active[i] = !active || across;
    if (p_.upper.size() > 0) held_.above[i] = above;
  }

  /// The nearest x within the bounds.
  Eigen::VectorXd projected(Eigen::VectorXd x) const {
    for (int i = 0; i < count(); ++i) x(p_.bounded[i]) = std::min(std::max(x(p_.bounded[i]), p_.lower(i)), upper(i));
    return x;
  }

  /// One step of Bertsekas' projected Newton method from a feasible x: it lowers the energy, so it cannot cycle.
  void descend() {
    if (descent_.size() == 0) descent_ = projected(x_);
    const Eigen::VectorXd gradient = p_.k.times(descent_) - p_.q;
    std::vector<char> held(gradient.size(), 0);
    for (int i = 0; i < count(); ++i) {
      const double x = descent_(p_.bounded[i]), g = gradient(p_.bounded[i]);
      held[p_.bounded[i]] = (x <= p_.lower(i) && g > 0) || (x >= upper(i) && g < 0) ? 1 : 0;
    }
    p_.k.hold(held);
    const Eigen::VectorXd direction = p_.k.solve(-gradient);
    double t = 1;
    Eigen::VectorXd next;
    for (int halvings = 0; halvings < 60; ++halvings, t /= 2) {
      next = projected(descent_ + t * direction);
      const Eigen::VectorXd change = next - descent_;
      if (change.dot(gradient + 0.5 * p_.k.times(change)) <= 1e-4 * change.dot(gradient)) break;
    }
    descent_ = std::move(next);
    ++steps_;
    for (int i = 0; i < count(); ++i) {
      const double x = descent_(p_.bounded[i]);
      const bool above = x >= upper(i) && x > p_.lower(i);
      held_.active[i] = x <= p_.lower(i) || above;
      if (p_.upper.size() > 0) held_.above[i] = above;
    }
  }

  const SparseContactProblem& p_;
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

}  // namespace

SparseContactAnswer solve_contact(const SparseContactProblem& problem, HeldBounds start, int max_steps) {
  return Iteration(problem, std::move(start)).run(max_steps);
}

HeldBounds nested_start(const SparseContactProblem& problem, int max_steps) {
  constexpr Eigen::Index few = 300;
  const std::size_t count = problem.bounded.size();
  const HeldBounds none(std::vector<bool>(count, false));
  if (problem.q.size() <= few) return none;
  const Aggregates aggregates = smoothed_aggregation(problem.k.upper());
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
    if (k.factorise(aggregates.coarse)) return none;
    SparseContactProblem coarse{k, q, bounded, lower, problem.u_scale};
    coarse.upper = mean_bound(problem.upper, coarse_of, coarse_count);
    answer = solve_contact(coarse, nested_start(coarse, max_steps), max_steps).contact;
  } catch (const Error&) {
    return none;  // a start, no more: the fine problem says what is wrong
  }
  HeldBounds start(std::vector<bool>(count), std::vector<bool>(problem.upper.size()));
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
  }
  return start;
}

}  // namespace antilock
