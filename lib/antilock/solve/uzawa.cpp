#include "antilock/solve/uzawa.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/core/dense.hpp"
#include "antilock/core/eigenvalues.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/contact_systems.hpp"
#include "antilock/solve/defaults.hpp"

namespace antilock {
namespace {

/// Steps between two checks of the duality gap, the hook and the clock: a step costs far less than
/// a check.
constexpr int check_interval = 32;

/// An upper bound of J(v+) - J(u_h) on Gamma_C, v+ = v moved to the nearest bound where it is
/// beyond, for v = S^-1 (q + lambda) and any lambda of the right signs: the energy of v+ less the
/// dual energy of lambda, -(q + lambda) S^-1 (q + lambda) / 2 + lambda bound (the lower one where
/// lambda > 0, the upper one where lambda < 0), which simplifies to
///     lambda (v+ - bound) + d S d / 2,   d = v+ - v the penetration.
/// A bound with a force limit moves nothing and adds the work that it takes up, the limit times the
/// distance.
double duality_gap(const Eigen::MatrixXd& s, const BoundLimits& bounds,
                   const ContactResult& result) {
  Eigen::VectorXd inside = result.v;
  double work = 0;
  for (int i = 0; i < bounds.count(); ++i) {
    const double low = bounds.lower(i), high = bounds.upper(i), lambda = result.lambda(i);
    if (std::isinf(bounds.force_limit(i))) inside(i) = std::clamp(inside(i), low, high);
    const double penetration = std::max(low - inside(i), inside(i) - high);
    if (lambda != 0) work += lambda * (inside(i) - (lambda > 0 ? low : high));
    if (penetration > 0) work += bounds.force_limit(i) * penetration;
  }
  const Eigen::VectorXd d = inside - result.v;
  return work + 0.5 * d.dot(s * d);
}

/// Uzawa on Gamma_C alone. The flexibility S^-1 maps contact forces to displacements.
class CondensedUzawa {
 public:
  CondensedUzawa(const PenalisedCholesky& factor, const UzawaOptions& options)
      : factor_(factor), options_(options) {}

  ContactResult operator()(const ContactSystem& system, const ShiftedBounds& asked,
                           const ContactResult& before, double u_scale) {
    const auto& given = dynamic_cast<const SchurComplementContact&>(system);
    const BoundLimits& bounds = asked;
    if (factor_.delta() != delta_)
      condense(given.s());          // the corrections may have taken another penalty
    Eigen::VectorXd q = given.q();  // the steps are taken on whole forces
    q -= asked.multiplier_estimate;
    ContactResult result;
    // the step is taken on f = q + lambda >= q: where the obstacle carries a large load, little is
    // left of the two
    Eigen::VectorXd f = q;
    if (before.lambda.size() > 0) f += before.lambda;
    while (true) {
      result.v = flexibility_ * f;
      result.lambda = f - q;
      const bool checks = result.steps % check_interval == 0;
      if (options_.stop_at && checks &&
          duality_gap(given.s(), bounds, result) <= options_.stop_at->energy)
        break;
      const Eigen::VectorXd next = projected_step(bounds, q, f, result.v);
      const double scale =
          std::max(result.v.cwiseAbs().maxCoeff(), u_scale);  // bounds far from v do not count
      const double change =
          scale > 0 ? (next - f).cwiseAbs().cwiseQuotient(rho_).maxCoeff() / scale : 0;
      f = next;
      ++result.steps;
      history.push_back(change);
      if (change <= options_.tolerance) break;
      if (result.steps % check_interval == 0)
        notify_or_throw(options_.progress,
                        {"contact", static_cast<int>(history.size()), change, options_.tolerance},
                        "uzawa");
      const bool late =
          result.steps % check_interval == 0 && watch_.seconds() > options_.max_seconds;
      if (!std::isfinite(change) || late ||
          static_cast<int>(history.size()) >= options_.max_iterations)
        throw NotConverged(
            fmt::format("uzawa: not converged: relative step {:.1e} after {} steps and {:.1f} s, "
                        "accepted {:.0e}; "
                        "active_set needs no step length",
                        change, history.size(), watch_.seconds(), options_.tolerance),
            change, static_cast<int>(history.size()));
    }
    result.v = flexibility_ * f;
    result.lambda = f - q;
    for (int i = 0; i < bounds.count(); ++i)
      result.status.push_back(status_of(bounds, i, q(i), f(i), result));
    return result;
  }

  std::vector<double> history;

 private:
  /// The status of (v, lambda): a bound with a force is active, unless the force is at its limit.
  BoundStatus status_of(const BoundLimits& bounds, int i, double q, double f,
                        ContactResult& result) const {
    const double limit = bounds.force_limit(i);
    const bool low = f >= q + limit, high = f <= q - limit;
    if (low || high) {
      if (low && high)
        result.lambda(i) = 0;
      else
        result.lambda(i) = low ? limit : -limit;
      if (low && high && result.v(i) >= bounds.lower(i) && result.v(i) <= bounds.upper(i))
        return BoundStatus::inactive;
      return low && (!high || result.v(i) < bounds.lower(i)) ? BoundStatus::slip_below
                                                             : BoundStatus::slip_above;
    }
    if (bounds.is_equation(i) || f > q) return BoundStatus::at_lower;
    return f < q ? BoundStatus::at_upper : BoundStatus::inactive;
  }

  /// lambda <- max(0, lambda - rho (v - lower)) + min(0, lambda - rho (v - upper)): of the two
  /// terms one is zero. In f that is q, moved up to f - rho (v - lower) or down to f - rho (v -
  /// upper), and no further than the force limit.
  Eigen::VectorXd projected_step(const BoundLimits& bounds, const Eigen::VectorXd& q,
                                 const Eigen::VectorXd& f, const Eigen::VectorXd& v) const {
    Eigen::VectorXd next = q.cwiseMin(f - rho_.cwiseProduct(v - bounds.upper));
    next = next.cwiseMax(f - rho_.cwiseProduct(v - bounds.lower));
    return next.cwiseMax(q - bounds.force_limit).cwiseMin(q + bounds.force_limit);
  }

  void condense(const Eigen::MatrixXd& s) {
    const Eigen::Index count = s.rows();
    const Eigen::MatrixXd inverse =
        Cholesky(s).forward(Eigen::MatrixXd(Eigen::MatrixXd::Identity(count, count)));
    flexibility_ = inverse.transpose() * inverse;
    delta_ = factor_.delta();
    if (options_.step_length) {
      rho_.setConstant(count, *options_.step_length);
      return;
    }
    // One step for all, or one per unknown, rho_i = rho / C_ii: where stiffnesses lie decades
    // apart, one step is too small for most. The one that contracts fastest is 2 / (largest +
    // smallest eigenvalue of W C).
    double best = std::numeric_limits<double>::infinity();
    for (const Eigen::VectorXd& weight : {Eigen::VectorXd(flexibility_.diagonal().cwiseInverse()),
                                          Eigen::VectorXd(Eigen::VectorXd::Ones(count))}) {
      const Eigen::VectorXd root = weight.cwiseSqrt();
      const double most = largest(flexibility_, root), least = 1 / largest(s, root.cwiseInverse());
      if (most / least > best) continue;
      best = most / least;
      rho_ = 2 / (most + least) * weight;
    }
  }

  /// The largest eigenvalue of D `matrix` D, D = diag(side).
  static double largest(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& side) {
    const auto scaled = [&](const Eigen::VectorXd& x) {
      return Eigen::VectorXd(side.cwiseProduct(matrix * Eigen::VectorXd(side.cwiseProduct(x))));
    };
    return largest_eigenvalue(scaled, matrix.rows());
  }

  const PenalisedCholesky& factor_;
  UzawaOptions options_;
  Eigen::MatrixXd flexibility_;
  Eigen::VectorXd rho_;  ///< C, the step of each force
  double delta_ = 0;
  Stopwatch watch_;
};

}  // namespace

Solution uzawa(const VariationalInequality& problem, PenalisedCholesky& factor,
               const UzawaOptions& options) {
  if (options.step_length && !(*options.step_length > 0))
    throw Error(
        fmt::format("uzawa: step_length = {}; accepted: a positive number", *options.step_length));
  CorrectionOptions corrections{
      std::max({options.tolerance, options.stop_at ? options.stop_at->relative : 0, 1e-12})};
  corrections.progress = options.progress;
  corrections.contact_tolerance = corrections.tolerance;
  if (factor.sparse_factor() != nullptr) factor.contact_block();  // says that there is none
  CondensedUzawa contact(factor, options);
  Solution solution = iterated_penalty(problem, factor, std::ref(contact), corrections, "uzawa");
  if (problem.bounds.count() == 0) return solution;
  solution.counters.contact_iterations = static_cast<int>(contact.history.size());
  solution.history = std::move(contact.history);
  return solution;
}

Solution uzawa(const VariationalInequality& problem, const UzawaOptions& options) {
  // its steps are products with S^-1, whose round-off no correction mends: a penalty that leaves it
  // more digits
  PenalisedCholesky factor(problem, defaults::penalty_reduction * choose_penalty(problem),
                           ContactReduction::schur_complement);
  return uzawa(problem, factor, options);
}

}  // namespace antilock
