#include "antilock/solve/uzawa.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/eigenvalues.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/solve/iterated_penalty.hpp"

namespace antilock {
namespace {

/// An upper bound of J(v+) - J(u_h) on Gamma_C, v+ = max(v, lower), for v = S^-1 (q + lambda) and any lambda >= 0: the
/// energy of v+ less the dual energy of lambda, -(q + lambda) S^-1 (q + lambda) / 2 + lambda lower, which simplifies to
///     lambda (v+ - lower) + d S d / 2,   d = v+ - v >= 0 what v sinks in.
double duality_gap(const ContactProblem& p, const ContactAnswer& answer) {
  const Eigen::VectorXd above = answer.v.cwiseMax(p.lower), d = above - answer.v;
  return answer.lambda.dot(above - p.lower) + 0.5 * d.dot(p.s * d);
}

/// Uzawa on Gamma_C alone. The compliance C = S^-1 maps contact forces to displacements.
class CondensedUzawa {
 public:
  CondensedUzawa(const PenaltyFactor& factor, const UzawaOptions& options) : factor_(factor), options_(options) {}

  ContactAnswer operator()(const ContactProblem& p, const ContactAnswer& before, int) {
    if (factor_.delta() != delta_) condense();  // the corrections may have taken another penalty
    ContactAnswer answer;
    // the step is taken on f = q + lambda >= q: where the obstacle bears a great load, little is left of the two
    Eigen::VectorXd f = p.q;
    if (before.lambda.size() > 0) f += before.lambda;
    while (true) {
      answer.v = compliance_ * f;
      answer.lambda = f - p.q;
      if (options_.enough && answer.steps % 32 == 0 && duality_gap(p, answer) <= options_.enough->energy) break;
      const Eigen::VectorXd next = (f - rho_ * (answer.v - p.lower)).cwiseMax(p.q);
      const double scale = std::max(answer.v.cwiseAbs().maxCoeff(), p.u_scale);  // bounds far from v do not count
      const double change = scale > 0 ? (next - f).cwiseAbs().maxCoeff() / rho_ / scale : 0;
      f = next;
      ++answer.steps;
      history.push_back(change);
      if (change <= options_.tolerance) break;
      if (answer.steps % 256 == 0)
        report(options_.progress, {"contact", static_cast<int>(history.size()), change, options_.tolerance}, "uzawa");
      const bool late = answer.steps % 256 == 0 && watch_.seconds() > options_.max_seconds;
      if (!std::isfinite(change) || late || static_cast<int>(history.size()) >= options_.max_steps)
        throw NotConverged(
            fmt::format("uzawa: not converged: relative step {:.1e} after {} steps and {:.1f} s, accepted {:.0e}",
                        change, history.size(), watch_.seconds(), options_.tolerance),
            change, static_cast<int>(history.size()));
    }
    answer.active.resize(p.q.size());
    for (Eigen::Index i = 0; i < p.q.size(); ++i) answer.active[i] = f(i) > p.q(i);
    answer.lambda = f - p.q;
    answer.v = compliance_ * f;
    return answer;
  }

  std::vector<double> history;

 private:
  void condense() {
    const auto& l = factor_.contact_block();
    const Eigen::MatrixXd inverse =
        l.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(l.rows(), l.cols()));
    compliance_ = inverse.transpose() * inverse;
    delta_ = factor_.delta();
    if (options_.step) {
      rho_ = *options_.step;
      return;
    }
    const Eigen::MatrixXd stiffness = l.triangularView<Eigen::Lower>() * l.transpose();
    const double largest =
        largest_eigenvalue([&](const Eigen::VectorXd& x) { return Eigen::VectorXd(compliance_ * x); }, l.rows());
    const double smallest =
        1 / largest_eigenvalue([&](const Eigen::VectorXd& x) { return Eigen::VectorXd(stiffness * x); }, l.rows());
    rho_ = 2 / (largest + smallest);
  }

  const PenaltyFactor& factor_;
  UzawaOptions options_;
  Eigen::MatrixXd compliance_;
  double delta_ = 0, rho_ = 0;
  Stopwatch watch_;
};

}  // namespace

Solution uzawa(const VariationalInequality& problem, PenaltyFactor& factor, const UzawaOptions& options) {
  factor.check_fits(problem);
  if (options.step && !(*options.step > 0))
    throw Error(fmt::format("uzawa: step = {}; accepted: a positive number", *options.step));
  CorrectionOptions corrections =
      corrections_to(std::max({options.tolerance, options.enough ? options.enough->relative : 0, 1e-12}));
  corrections.progress = options.progress;
  corrections.contact = corrections.tolerance;
  if (problem.contact.empty()) return iterated_penalty(problem, factor, {}, corrections, "uzawa");
  CondensedUzawa contact(factor, options);
  Solution solution = iterated_penalty(problem, factor, std::ref(contact), corrections, "uzawa");
  solution.counters.contact = static_cast<int>(contact.history.size());
  solution.history = std::move(contact.history);
  return solution;
}

Solution uzawa(const VariationalInequality& problem, const UzawaOptions& options) {
  PenaltyFactor factor = PenaltyFactor::moderate(problem, options.penalty);
  return uzawa(problem, factor, options);
}

}  // namespace antilock
