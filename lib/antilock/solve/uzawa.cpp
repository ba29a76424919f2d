#include "antilock/solve/uzawa.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "antilock/core/dense.hpp"
#include "antilock/core/eigenvalues.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/contact_bounds.hpp"
#include "antilock/solve/handed_back.hpp"
#include "antilock/solve/iterated_penalty.hpp"

namespace antilock {
namespace {

/// The nearest x to the bounds [low, high]: x itself between them. Entries of high may be infinite; empty: all are.
Eigen::VectorXd between(const Eigen::VectorXd& low, const Eigen::VectorXd& x, const Eigen::VectorXd& high) {
  return low.cwiseMax(high.size() > 0 ? Eigen::VectorXd(x.cwiseMin(high)) : x);
}

/// The most that bound i bears; infinite: anything.
double bears(const ContactProblem& p, Eigen::Index i) {
  return p.most.size() > 0 ? p.most(i) : std::numeric_limits<double>::infinity();
}

/// An upper bound of J(v+) - J(u_h) on Gamma_C, v+ = v moved to the nearest bound where it is beyond, for v = S^-1 (q +
/// lambda) and any lambda of the right signs: the energy of v+ less the dual energy of lambda, -(q + lambda) S^-1 (q +
/// lambda) / 2 + lambda bound (the lower one where lambda > 0, the upper one where lambda < 0), which simplifies to
///     lambda (v+ - bound) + d S d / 2,   d = v+ - v what v sinks in.
/// A bound that gives way moves nothing and adds the work that it takes up, most times the distance from it.
double duality_gap(const ContactProblem& p, const ContactAnswer& answer) {
  const HeldBounds reached = ContactBounds{p.lower, p.upper, p.most}.reached(answer.v);
  const Eigen::VectorXd inside = ContactBounds{p.lower, p.upper, p.most}.nearest(answer.v), d = inside - answer.v;
  double work = 0;
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    if (const double lambda = answer.lambda(i); lambda != 0)
      work += lambda * (inside(i) - (lambda > 0 ? p.lower(i) : p.upper(i)));
    if (const int beyond = is_beyond(reached, static_cast<int>(i)); beyond != 0)
      work += p.most(i) * std::abs(inside(i) - (beyond < 0 ? p.lower(i) : p.upper(i)));
  }
  return work + 0.5 * d.dot(p.s * d);
}

/// Uzawa on Gamma_C alone. The compliance C = S^-1 maps contact forces to displacements.
class CondensedUzawa {
 public:
  CondensedUzawa(const PenaltyFactor& factor, const UzawaOptions& options) : factor_(factor), options_(options) {}

  /// Equations (lower = upper) are solved for their forces: a step would move those freely, at a rate of its own.
  ContactAnswer operator()(const ContactProblem& p, const ContactAnswer& before, int) {
    std::vector<int> equations, open;
    for (int i = 0; i < static_cast<int>(p.q.size()); ++i)
      (p.upper.size() > 0 && p.lower(i) == p.upper(i) && std::isinf(bears(p, i)) ? equations : open).push_back(i);
    if (equations.empty()) return stepped(p, before);
    ContactAnswer answer;
    answer.v = p.lower;
    answer.active.assign(p.q.size(), true);
    answer.beyond.assign(p.most.size(), 0);
    if (!open.empty()) {
      const Eigen::MatrixXd s = p.s(open, open);
      const Eigen::VectorXd q = p.q(open) - p.s(open, equations) * p.lower(equations), lower = p.lower(open);
      ContactAnswer of_open;
      if (before.lambda.size() > 0) of_open.lambda = before.lambda(open);
      ContactProblem problem{s, q, lower, p.u_scale};
      problem.upper = p.upper(open);
      if (p.most.size() > 0) problem.most = p.most(open);
      of_open = stepped(problem, of_open);
      answer.v(open) = of_open.v;
      answer.steps = of_open.steps;
      for (std::size_t i = 0; i < open.size(); ++i) {
        answer.active[open[i]] = of_open.active[i];
        if (p.most.size() > 0) answer.beyond[open[i]] = of_open.beyond[i];
      }
    }
    answer.lambda = p.s * answer.v - p.q;
    for (const int i : open)
      if (!answer.active[i]) {
        const int beyond = answer.beyond.empty() ? 0 : answer.beyond[i];
        answer.lambda(i) = beyond == 0 ? 0 : -beyond * p.most(i);
      }
    return answer;
  }

  std::vector<double> history;

 private:
  ContactAnswer stepped(const ContactProblem& p, const ContactAnswer& before) {
    if (factor_.delta() != delta_) condense(p.s);  // the corrections may have taken another penalty
    ContactAnswer answer;
    // the step is taken on f = q + lambda >= q: where the obstacle bears a great load, little is left of the two
    Eigen::VectorXd f = p.q;
    if (before.lambda.size() > 0) f += before.lambda;
    while (true) {
      answer.v = compliance_ * f;
      answer.lambda = f - p.q;
      if (options_.enough && answer.steps % 32 == 0 && duality_gap(p, answer) <= options_.enough->energy) break;
      const Eigen::VectorXd next = projected_step(p, f, answer.v);
      const double scale = std::max(answer.v.cwiseAbs().maxCoeff(), p.u_scale);  // bounds far from v do not count
      const double change = scale > 0 ? (next - f).cwiseAbs().cwiseQuotient(rho_).maxCoeff() / scale : 0;
      f = next;
      ++answer.steps;
      history.push_back(change);
      if (change <= options_.tolerance) break;
      if (answer.steps % 256 == 0)
        report(options_.progress, {"contact", static_cast<int>(history.size()), change, options_.tolerance}, "uzawa");
      const bool late = answer.steps % 256 == 0 && watch_.seconds() > options_.max_seconds;
      if (!std::isfinite(change) || late || static_cast<int>(history.size()) >= options_.max_steps)
        throw NotConverged(
            fmt::format("uzawa: not converged: relative step {:.1e} after {} steps and {:.1f} s, accepted {:.0e}; "
                        "active_set needs no step length",
                        change, history.size(), watch_.seconds(), options_.tolerance),
            change, static_cast<int>(history.size()));
    }
    answer.v = compliance_ * f;
    take_bounds(p, f, answer);
    return answer;
  }

  /// lambda, and which bounds bear it: all that push, or that hold an equation, but not those that bear their most.
  void take_bounds(const ContactProblem& p, const Eigen::VectorXd& f, ContactAnswer& answer) const {
    answer.lambda = f - p.q;
    answer.active.resize(f.size());
    answer.beyond.assign(p.most.size(), 0);
    for (Eigen::Index i = 0; i < f.size(); ++i) {
      const double most = bears(p, i);
      const bool low = f(i) >= p.q(i) + most, high = f(i) <= p.q(i) - most;
      const bool equation = p.upper.size() > 0 && p.lower(i) == p.upper(i);
      answer.active[i] = !low && !high && (f(i) != p.q(i) || (equation && std::isfinite(most)));
      if (low || high) answer.beyond[i] = low && (!high || answer.v(i) < p.lower(i)) ? -1 : 1;
      if (low || high) answer.lambda(i) = low && high ? 0 : low ? most : -most;
    }
  }

  /// lambda <- max(0, lambda - rho (v - lower)) + min(0, lambda - rho (v - upper)): of the two terms one is zero. In f
  /// that is q, moved up to f - rho (v - lower) or down to f - rho (v - upper), and no further than a bound bears.
  Eigen::VectorXd projected_step(const ContactProblem& p, const Eigen::VectorXd& f, const Eigen::VectorXd& v) const {
    const Eigen::VectorXd up = f - rho_.cwiseProduct(v - p.lower);
    Eigen::VectorXd next =
        between(up, p.q, p.upper.size() > 0 ? Eigen::VectorXd(f - rho_.cwiseProduct(v - p.upper)) : Eigen::VectorXd());
    if (p.most.size() > 0) next = next.cwiseMax(p.q - p.most).cwiseMin(p.q + p.most);
    return next;
  }

  void condense(const Eigen::MatrixXd& s) {
    const Eigen::Index count = s.rows();
    const Eigen::MatrixXd inverse = Cholesky(s).half_solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(count, count)));
    compliance_ = inverse.transpose() * inverse;
    delta_ = factor_.delta();
    if (options_.step) {
      rho_.setConstant(count, *options_.step);
      return;
    }
    // One step for all, or one per unknown, rho_i = rho / C_ii: where stiffnesses lie decades apart, one step is too
    // small for most.
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(count), each = compliance_.diagonal().cwiseInverse();
    const Step common = best_step(s, one), own = best_step(s, each);
    rho_ = 4 * own.condition < common.condition ? Eigen::VectorXd(own.length * each) : common.length * one;
  }

  /// The step rho weight_i that contracts fastest, 2 / (largest + smallest eigenvalue of W C), and their ratio.
  struct Step {
    double length, condition;
  };
  Step best_step(const Eigen::MatrixXd& s, const Eigen::VectorXd& weight) const {
    const Eigen::VectorXd root = weight.cwiseSqrt();
    const auto largest = [&](const Eigen::MatrixXd& matrix, const Eigen::VectorXd& side) {
      return largest_eigenvalue(
          [&](const Eigen::VectorXd& x) {
            return Eigen::VectorXd(side.cwiseProduct(matrix * Eigen::VectorXd(side.cwiseProduct(x))));
          },
          s.rows());
    };
    const double most = largest(compliance_, root), least = 1 / largest(s, root.cwiseInverse());
    return {2 / (most + least), most / least};
  }

  const PenaltyFactor& factor_;
  UzawaOptions options_;
  Eigen::MatrixXd compliance_;
  Eigen::VectorXd rho_;  ///< C, the step of each force
  double delta_ = 0;
  Stopwatch watch_;
};

CorrectionOptions asked_of_corrections(const UzawaOptions& options) {
  return corrections_to(std::max({options.tolerance, options.enough ? options.enough->relative : 0, 1e-12}));
}

}  // namespace

Solution uzawa(const VariationalInequality& problem, PenaltyFactor& factor, const UzawaOptions& options) {
  require_bounds_on_unknowns(problem, "uzawa with a factor made before");
  factor.check_fits(problem);
  if (options.step && !(*options.step > 0))
    throw Error(fmt::format("uzawa: step = {}; accepted: a positive number", *options.step));
  CorrectionOptions corrections = asked_of_corrections(options);
  corrections.progress = options.progress;
  corrections.contact = corrections.tolerance;
  if (problem.contact.empty()) return iterated_penalty(problem, factor, {}, corrections, "uzawa");
  if (factor.held() != nullptr) factor.contact_block();  // says that there is none
  CondensedUzawa contact(factor, options);
  Solution solution =
      iterated_penalty(problem, factor, {.dense = std::ref(contact), .sparse = {}}, corrections, "uzawa");
  solution.counters.contact = static_cast<int>(contact.history.size());
  solution.history = std::move(contact.history);
  return solution;
}

Solution uzawa(const VariationalInequality& problem, const UzawaOptions& options) {
  if (problem.combinations.rows() > 0) {
    check_data(problem);
    const BoundedUnknowns basis(problem);
    return handed_back(problem, basis, uzawa(basis.problem, options),
                       TrustLevels{.refused = asked_of_corrections(options).refused});
  }
  PenaltyFactor factor = PenaltyFactor::moderate(problem, options.penalty, ContactRoad::dense);
  return uzawa(problem, factor, options);
}

}  // namespace antilock
