#include "antilock/solve/iterated_penalty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/anderson.hpp"
#include "antilock/solve/residual.hpp"
#include "antilock/solve/verifier.hpp"

namespace antilock {
namespace {

/// Corrections with one penalty: a new factor costs as much as 10 to 20 (measured at 1/h = 128).
constexpr int patience = 15;
/// By which the next penalty is smaller. A correction contracts like delta / (delta + sigma): 0.9 becomes 0.12.
constexpr double smaller_by = 64;

/// One solve: the factor and where the iterates stand.
class IteratedPenalty {
 public:
  IteratedPenalty(const VariationalInequality& problem, PenaltyFactor& factor, const ContactSolver& contact,
                  const CorrectionOptions& options, const std::string& name)
      : problem_(problem),
        factor_(factor),
        solve_contact_(contact),
        options_(options),
        u_(Eigen::VectorXd::Zero(problem.size())),
        p_(Eigen::VectorXd::Zero(problem.b.rows())) {
    u_.high(problem.fixed) = problem.fixed_values;
    s_.solver = name;
    take(factor.delta());
  }

  Solution solve() {
    for (int correction = 0;; ++correction) {
      const Correction step = correct(exact_residual(problem_, u_, p_, contact_.lambda), correction);
      const double largest = u_.high.lpNorm<Eigen::Infinity>(), moved = step.u.lpNorm<Eigen::Infinity>();
      if (correction == 0) s_.moderate = largest;
      const Accuracy now = accuracy(problem_, u_, step.u, step.left_of_r2, rate(moved), s_.moderate, options_);
      s_.history.push_back(largest > 0 ? moved / largest : 0);
      s_.counters.corrections = correction;
      if (now.error <= options_.tolerance && now.open <= 1) return finished();
      if (correction % 5 == 4) require_an_admissible_u(problem_, u_.high, s_);
      if (correction >= options_.max_corrections || !std::isfinite(moved))
        throw NotConverged(fmt::format("{}: not converged, or infeasible: after {} corrections the estimated relative "
                                       "error of u is {:.1e}, accepted {:.0e}, and compliance p = B u holds to {:.1e} "
                                       "of what is accepted",
                                       s_.solver, correction, now.error, options_.tolerance, now.open),
                           std::max(now.error, options_.tolerance * now.open), correction);
      report(options_.progress, {"corrections", correction + 1, now.error, options_.tolerance}, s_.solver);
      acceleration_.mix(p_, u_);
      if (correction % patience == patience - 1) take(factor_.delta() / smaller_by);
    }
  }

 private:
  /// du, and what the correction leaves of r2.
  struct Correction {
    Eigen::VectorXd u, left_of_r2;  ///< N, R
  };

  /// K du = r1 + delta^-1 B' M r2 + dlambda on the free places, dp = (B du - r2) / delta.
  Correction correct(SplitResidual r, int correction) {
    const std::vector<int>&unknown = factor_.numbering().unknown, &contact = problem_.contact;
    if (p_.size() > 0) r.r1 += problem_.b.transpose() * (problem_.m.cwiseProduct(r.r2) / factor_.delta());
    const auto from_u = [&](const Eigen::VectorXd& bound) -> Eigen::VectorXd {  // the bounds of du
      return bound.size() > 0 ? Eigen::VectorXd(bound - u_.high(contact) - u_.low(contact)) : bound;
    };
    const Eigen::VectorXd lower = from_u(problem_.lower), upper = from_u(problem_.upper);
    const HeldBounds before = held_by(contact_);
    Correction step{Eigen::VectorXd::Zero(problem_.size()), {}};
    const Eigen::VectorXd du = factor_.held() != nullptr ? sparse_road(r.r1(unknown), lower, upper, correction)
                                                         : dense_road(r.r1(unknown), lower, upper, correction);
    step.u(unknown) = du;
    u_ += step.u;
    for (Eigen::Index i = 0; i < lower.size(); ++i)  // what is held stands where its bound is, to the last digit
      if (contact_.v(i) == lower(i))
        u_.set(contact[i], problem_.lower(i));
      else if (upper.size() > 0 && contact_.v(i) == upper(i))
        u_.set(contact[i], problem_.upper(i));
    if (p_.size() == 0) return step;
    const Eigen::VectorXd dp = (problem_.b * step.u - r.r2) / factor_.delta();
    p_ += dp;
    step.left_of_r2 = (problem_.compliance - factor_.delta()) * dp;
    if (contact_.active != before.active || contact_.above != before.above || contact_.beyond != before.beyond)
      acceleration_.restart();
    acceleration_.note(p_, dp, u_);
    return step;
  }

  /// The contact problem condensed on Gamma_C, the last C places of the factor.
  Eigen::VectorXd dense_road(Eigen::VectorXd r, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, int correction) {
    const Eigen::Index c = lower.size();
    Stopwatch watch;
    // what acts on Gamma_C itself stays out of the factor: a great load there, which the obstacle bears, would leave
    // its round-off on the neighbours
    const Eigen::VectorXd r_c = r.tail(c), none = Eigen::VectorXd::Zero(c);
    r.tail(c).setZero();
    Eigen::VectorXd y = factor_.forward(r);
    s_.seconds.solve += watch.lap();
    if (c > 0) {
      const auto l = factor_.contact_block().triangularView<Eigen::Lower>();
      Eigen::VectorXd q = r_c + l * y.tail(c);
      if (contact_.lambda.size() > 0) q -= contact_.lambda;  // r holds them already; contact asks for all
      const double size = u_.high.lpNorm<Eigen::Infinity>();
      contact_ = solve_contact_.dense({schur_, q, lower, size, {}, none, upper, problem_.force_bound}, contact_, correction);
      y.tail(c) = l.transpose() * contact_.v;
      s_.seconds.contact += watch.lap();
    }
    Eigen::VectorXd du = factor_.backward(std::move(y));
    s_.seconds.solve += watch.lap();
    return du;
  }

  /// The same on all free places.
  Eigen::VectorXd sparse_road(Eigen::VectorXd r, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, int correction) {
    const Stopwatch watch;
    std::vector<int> bounded(problem_.contact.size());
    std::iota(bounded.begin(), bounded.end(), factor_.numbering().interior);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(lower.size());
    if (contact_.lambda.size() > 0) r.tail(lower.size()) -= contact_.lambda;
    const double size = u_.high.lpNorm<Eigen::Infinity>();
    SparseContactAnswer answer = solve_contact_.sparse(
        {*factor_.held(), r, bounded, lower, size, {}, none, upper, problem_.force_bound}, contact_, correction);
    contact_ = std::move(answer.contact);
    s_.seconds.contact += watch.seconds();
    return std::move(answer.x);
  }

  /// By how much a correction brings u closer: as the past tells; at first, without B, the round-off of the factor.
  double rate(double moved) const {
    if (p_.size() > 0) return acceleration_.contraction();
    if (s_.history.empty()) return std::min(0.99, rounding_of_the_factor(problem_, factor_));
    const double before = s_.history.back() * u_.high.lpNorm<Eigen::Infinity>();
    return moved < before ? std::clamp(moved / before, 0.01, 0.99) : 0.99;
  }

  /// Another penalty, no smaller than the compliance and than what leaves a factor digits of A1.
  void take(double delta) {
    const double before = factor_.delta();
    delta = std::max({delta, problem_.compliance, std::min(before, smallest_penalty(problem_))});
    if (delta < before) try {
        factor_.refactor(problem_, delta);
      } catch (const Error&) {  // flat cells: no positive pivots
        factor_.refactor(problem_, before);
      }
    const Stopwatch watch;
    if (const bool dense = factor_.held() == nullptr; dense && factor_.contact_block().size() > 0)
      schur_ = factor_.contact_block().triangularView<Eigen::Lower>() * factor_.contact_block().transpose();
    s_.seconds.contact += watch.seconds();
    acceleration_.restart();
  }

  Solution finished() {
    s_.counters.unknowns = problem_.free_count();
    s_.counters.factorisations = factor_.work().factorisations;
    if (factor_.held() != nullptr) s_.counters.factorisations += factor_.held()->refactorisations();
    s_.counters.solves = s_.counters.corrections + 1;
    s_.seconds.analyse = factor_.work().analyse_seconds;
    s_.seconds.factor = factor_.work().factor_seconds;
    s_.active = contact_.active;
    s_.u = std::move(u_.high);
    s_.p = std::move(p_.high);
    s_.lambda = contact_.lambda.size() > 0 ? contact_.lambda : Eigen::VectorXd::Zero(problem_.bound_count());
    judge(problem_, factor_, options_.refused, s_);
    return std::move(s_);
  }

  const VariationalInequality& problem_;
  PenaltyFactor& factor_;
  const ContactSolver& solve_contact_;
  const CorrectionOptions& options_;
  Solution s_;             ///< what is counted
  Twice u_, p_;            ///< N, R
  ContactAnswer contact_;  ///< of the last correction: forces, contact set
  Eigen::MatrixXd schur_;  ///< C x C, S = L_C L_C', of the factor as it is now; empty on the sparse road
  Anderson acceleration_{6};
};

}  // namespace

CorrectionOptions corrections_to(double asked) {
  CorrectionOptions options;
  options.tolerance = asked;
  options.refused = std::max(options.refused, 10 * asked);
  return options;
}

Solution iterated_penalty(const VariationalInequality& problem, PenaltyFactor& factor, const ContactSolver& contact,
                          const CorrectionOptions& options, const std::string& name) {
  require_bounds_on_unknowns(problem, name);
  return IteratedPenalty(problem, factor, contact, options, name).solve();
}

}  // namespace antilock
