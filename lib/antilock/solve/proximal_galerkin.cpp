#include "antilock/solve/proximal_galerkin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/flexibility.hpp"
#include "antilock/solve/kkt.hpp"

namespace antilock {
namespace {

const std::string name = "proximal_galerkin";

/// A value that no force moves must be inside its bounds by this fraction of the size that u has
/// without locking.
constexpr double least_distance = 1e-12;

void check_options(const VariationalInequality& problem, const ProximalGalerkinOptions& options) {
  require_hard_bounds(problem.bounds, name);
  if (!(options.tolerance > 0))
    throw Error(fmt::format("{}: tolerance {}; accepted: above 0", name, options.tolerance));
  if (options.max_proximal_steps < 1 || options.max_newton_steps < 1)
    throw Error(
        fmt::format("{}: at most {} proximal and {} Newton steps; accepted: 1 or more of each",
                    name, options.max_proximal_steps, options.max_newton_steps));
  for (int i = 0; i < problem.bounds.count(); ++i)
    if (problem.bounds.is_equation(i))
      throw Error(fmt::format(
          "{}: bound {} is an equation, lower = upper = {}, which has no inner point; accepted: "
          "lower < upper, or the solver active_set",
          name, i, problem.bounds.upper(i)));
}

/// The maps from the latent variable psi to the values of C bounds.
class LatentMap {
 public:
  LatentMap(Eigen::VectorXd lower, Eigen::VectorXd upper, double reach)
      : lower_(std::move(lower)), upper_(std::move(upper)), reach_(reach) {}

  double value(Eigen::Index i, double psi) const {
    if (!std::isfinite(upper_(i))) return lower_(i) + reach_ * std::exp(psi);
    if (!std::isfinite(lower_(i))) return upper_(i) - reach_ * std::exp(-psi);
    const double range = upper_(i) - lower_(i);
    // each form keeps the digits of the distance to the nearer bound
    return psi < 0 ? lower_(i) + range * logistic(psi) : upper_(i) - range * logistic(-psi);
  }
  double derivative(Eigen::Index i, double psi) const {
    if (!std::isfinite(upper_(i))) return reach_ * std::exp(psi);
    if (!std::isfinite(lower_(i))) return reach_ * std::exp(-psi);
    return (upper_(i) - lower_(i)) * logistic(psi) * logistic(-psi);
  }
  Eigen::VectorXd values(const Eigen::VectorXd& psi) const {
    Eigen::VectorXd all(psi.size());
    for (Eigen::Index i = 0; i < psi.size(); ++i) all(i) = value(i, psi(i));
    return all;
  }
  Eigen::VectorXd derivatives(const Eigen::VectorXd& psi) const {
    Eigen::VectorXd all(psi.size());
    for (Eigen::Index i = 0; i < psi.size(); ++i) all(i) = derivative(i, psi(i));
    return all;
  }

 private:
  static double logistic(double psi) { return 1 / (1 + std::exp(-psi)); }
  Eigen::VectorXd lower_, upper_;
  double reach_;
};

/// The proximal steps on the C bounds alone. All quantities are scaled: values are divided by
/// sqrt(F_ii), and forces are multiplied by it.
class ProximalPoint {
 public:
  /// `bounds` are the C bounds that take part. Their flexibilities are positive.
  ProximalPoint(const VariationalInequality& problem, const Flexibility& flexibility,
                const std::vector<int>& bounds, const ProximalGalerkinOptions& options)
      : options_(options),
        root_(Eigen::VectorXd(flexibility.f.diagonal()(bounds)).cwiseSqrt()),
        w_(flexibility.w(bounds).cwiseQuotient(root_)),
        f_(root_.cwiseInverse().asDiagonal() * Eigen::MatrixXd(flexibility.f(bounds, bounds)) *
           root_.cwiseInverse().asDiagonal()),
        lower_(problem.bounds.lower(bounds).cwiseQuotient(root_)),
        upper_(problem.bounds.upper(bounds).cwiseQuotient(root_)) {
    for (Eigen::Index i = 0; i < w_.size(); ++i)
      for (const double bound : {lower_(i), upper_(i)})
        if (std::isfinite(bound)) reach_ = std::max(reach_, std::abs(w_(i) - bound));
    force_ = reach_ / f_.cwiseAbs().rowwise().sum().maxCoeff();
  }

  /// Runs proximal steps until s changes no more, and returns the forces lambda (C). A second call
  /// continues.
  Eigen::VectorXd run() {
    const LatentMap map(lower_, upper_, reach_);
    if (psi_.size() == 0) psi_ = Eigen::VectorXd::Zero(w_.size());
    s_ = map.values(psi_);
    for (bool settled = false; !settled;) {
      const int k = static_cast<int>(history.size());
      if (k >= options_.max_proximal_steps) refuse_more_steps();
      const double alpha = options_.step_length ? options_.step_length(k) : std::ldexp(1.0, k);
      if (!(alpha > 0) || !std::isfinite(alpha))
        throw Error(fmt::format("{}: the length of step {} is {}; accepted: a positive number",
                                name, k, alpha));
      const Eigen::VectorXd before = psi_;
      psi_ = newton(map, before, alpha, k);
      lambda_ = force_ / alpha * (before - psi_);
      const Eigen::VectorXd next = map.values(psi_);
      history.push_back((next - s_).lpNorm<Eigen::Infinity>() / size_of(next));
      s_ = next;
      settled = history.back() <= options_.tolerance;
      notify_or_throw(options_.corrections.progress,
                      {"proximal steps", k + 1, history.back(), options_.tolerance}, name);
    }
    return lambda_.cwiseQuotient(root_);
  }

  /// Returns whether s(psi) is s (C), the bounded values of the linear solve with lambda. In any
  /// case w becomes s - F lambda, so that the errors of w and F count only for later changes of
  /// lambda.
  bool agrees_with(const Eigen::VectorXd& s) {
    const Eigen::VectorXd scaled = s.cwiseQuotient(root_);
    w_ = scaled - f_ * lambda_;
    return (scaled - s_).lpNorm<Eigen::Infinity>() <= options_.tolerance * size_of(s_);
  }

  /// Returns C statuses: a bound is active where |lambda_i| F_ii is larger than the distance from
  /// it.
  BoundStatuses statuses() const {
    BoundStatuses all;
    for (Eigen::Index i = 0; i < s_.size(); ++i) {
      BoundStatus status = BoundStatus::inactive;
      if (lambda_(i) > s_(i) - lower_(i)) status = BoundStatus::at_lower;
      if (-lambda_(i) > upper_(i) - s_(i)) status = BoundStatus::at_upper;
      all.push_back(status);
    }
    return all;
  }

  std::vector<double> history;  ///< relative change of s in each proximal step
  int newton_steps = 0;

 private:
  /// Solves s(psi) + force F (psi - before) / alpha = w, the gradient of a convex function of psi.
  Eigen::VectorXd newton(const LatentMap& map, const Eigen::VectorXd& before, double alpha,
                         int proximal_step) {
    const Eigen::MatrixXd stiff = force_ / alpha * f_;
    const auto gradient = [&](const Eigen::VectorXd& psi) {
      return Eigen::VectorXd(map.values(psi) - w_ + stiff * (psi - before));
    };
    Eigen::VectorXd psi = before, residual = gradient(psi), step;
    for (int k = 0; k < options_.max_newton_steps; ++k) {
      Eigen::MatrixXd hessian = stiff;
      hessian.diagonal() += map.derivatives(psi);
      const Cholesky factor(std::move(hessian));
      ++newton_steps;
      if (!factor.positive_definite()) break;  // derivatives of 0 where F is singular
      step = -factor.solve(residual);
      if (newton_step_has_converged(step, psi - before)) return psi + step;
      const double slope = step.dot(residual);
      double length = 1;
      Eigen::VectorXd next = psi + step;
      residual = gradient(next);
      // the slope of the convex function along the step, which is not finite where exp overflows
      while (!(step.dot(residual) <= -0.5 * slope) && length > 1e-6) {
        length /= 2;
        next = psi + length * step;
        residual = gradient(next);
      }
      psi = std::move(next);
    }
    refuse(psi - before, alpha, proximal_step);
  }

  /// Throws NotConverged because of Newton's method. `moved` (C) is the change of psi in this step.
  [[noreturn]] void refuse(const Eigen::VectorXd& moved, double alpha, int proximal_step) const {
    Eigen::Index furthest = 0;
    moved.cwiseAbs().maxCoeff(&furthest);
    throw NotConverged(
        fmt::format("{}: no solution of proximal step {} (length {:g}): the latent variable of "
                    "bound {} moved by {:.1e} and did not settle in {} Newton steps; accepted: a "
                    "K_h with an inner point, and bounds on independent values",
                    name, proximal_step, alpha, furthest, moved(furthest), newton_steps),
        1, newton_steps);
  }

  [[noreturn]] void refuse_more_steps() const {
    throw NotConverged(
        fmt::format("{}: not converged: relative change {:.1e} after {} proximal and {} Newton "
                    "steps, accepted {:.0e}",
                    name, history.back(), history.size(), newton_steps, options_.tolerance),
        history.back(), static_cast<int>(history.size()));
  }

  /// The size by which changes of s are divided. It is at least 1e-6 R, because all s may tend to
  /// bounds at 0.
  double size_of(const Eigen::VectorXd& s) const {
    return std::max(s.lpNorm<Eigen::Infinity>(), 1e-6 * reach_);
  }

  const ProximalGalerkinOptions& options_;
  Eigen::VectorXd root_;  ///< C: sqrt(F_ii)
  Eigen::VectorXd w_;     ///< C
  Eigen::MatrixXd f_;     ///< C x C, its diagonal is 1
  Eigen::VectorXd lower_, upper_;
  double reach_ = 0;                  ///< R
  double force_ = 0;                  ///< c_i of the scaled problem
  Eigen::VectorXd psi_, s_, lambda_;  ///< C, of the last step
};

/// Returns the bounds whose values forces can move. A value that no force moves is left out if it
/// lies strictly inside its bounds. Otherwise NotConverged is thrown.
std::vector<int> movable_bounds(const VariationalInequality& problem,
                                const Flexibility& flexibility) {
  std::vector<int> movable, fixed;
  for (int i = 0; i < problem.bounds.count(); ++i) {
    if (!flexibility.is_fixed(i)) {
      movable.push_back(i);
      continue;
    }
    const double w = flexibility.w(i);
    const double inside = std::min(w - problem.bounds.lower(i), problem.bounds.upper(i) - w);
    if (!(inside > least_distance * flexibility.free.penalised_max_u)) fixed.push_back(i);
  }
  if (!fixed.empty())
    throw NotConverged(fmt::format("{}: no solution of a proximal step: no force moves {} of the "
                                   "{} bounded values off their bounds "
                                   "(the first is bound {}), so K_h has no inner point, as where "
                                   "an element locks; accepted: a K_h "
                                   "with an inner point, or the solver active_set",
                                   name, fixed.size(), problem.bounds.count(), fixed.front()),
                       1, 0);
  return movable;
}

bool violates_no_bound(const VariationalInequality& problem, const Eigen::VectorXd& s) {
  const bool above = (s.array() >= problem.bounds.lower.array()).all();
  return above && (s.array() <= problem.bounds.upper.array()).all();
}

}  // namespace

bool newton_step_has_converged(const Eigen::VectorXd& step, const Eigen::VectorXd& moved) {
  constexpr double tolerance = 1e-7;
  return (step.array().abs() <= tolerance * (1 + moved.array().abs())).all();
}

Solution proximal_galerkin(const VariationalInequality& problem, PenalisedCholesky& factor,
                           const ProximalGalerkinOptions& options) {
  check_data(problem);
  check_options(problem, options);
  Stopwatch watch;
  LinearResponse linear(problem, factor, options.corrections);
  const int count = problem.bounds.count();
  const Flexibility flexibility = linear.flexibility();
  const double linear_seconds = watch.lap();
  const std::vector<int> movable = movable_bounds(problem, flexibility);
  Solution result = flexibility.free;
  result.lambda = Eigen::VectorXd::Zero(count);
  result.status.assign(count, BoundStatus::inactive);
  if (!violates_no_bound(problem, flexibility.w)) {
    ProximalPoint iteration(problem, flexibility, movable, options);
    Eigen::VectorXd lambda = result.lambda;
    int solves = (count + 1) * result.counters.solves;
    do {
      lambda(movable) = iteration.run();
      result = linear.solve(lambda);
      solves += result.counters.solves;
    } while (!iteration.agrees_with(bounded_values(problem.bounds, result.u)(movable)));
    result.lambda = std::move(lambda);
    result.status.assign(count, BoundStatus::inactive);
    const BoundStatuses statuses = iteration.statuses();
    for (std::size_t i = 0; i < movable.size(); ++i) result.status[movable[i]] = statuses[i];
    result.seconds.contact = watch.lap();
    result.history = std::move(iteration.history);
    result.counters.contact_iterations = iteration.newton_steps;
    result.counters.solves = solves;
    result.error += result.history.back();
  }
  result.solver = "proximal Galerkin";
  result.seconds.solve += linear_seconds;
  result.active.clear();
  for (const BoundStatus status : result.status) result.active.push_back(is_active(status));
  check_kkt(problem, result,
            {.fail = std::max(options.corrections.kkt_fail(), 10 * options.tolerance)});
  return result;
}

Solution proximal_galerkin(const VariationalInequality& problem,
                           const ProximalGalerkinOptions& options) {
  check_data(problem);
  VariationalInequality linear = problem;
  linear.bounds = {};
  PenalisedCholesky factor(linear);
  return proximal_galerkin(problem, factor, options);
}

}  // namespace antilock
