#include "antilock/solve/active_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/anderson.hpp"
#include "antilock/solve/contact_systems.hpp"
#include "antilock/solve/defaults.hpp"
#include "antilock/solve/detail/slack_form.hpp"
#include "antilock/solve/forward_error.hpp"
#include "antilock/solve/kkt.hpp"
#include "antilock/solve/residual.hpp"

namespace antilock {
namespace {

/// One solve: the factor and the iterates.
class IteratedPenalty {
 public:
  IteratedPenalty(const VariationalInequality& problem, PenalisedCholesky& factor,
                  const ContactSolver& contact, const CorrectionOptions& options,
                  const std::string& name)
      : problem_(problem),
        factor_(factor),
        contact_solver_(contact),
        options_(options),
        u_(Eigen::VectorXd::Zero(problem.size())),
        p_(Eigen::VectorXd::Zero(problem.b.rows())) {
    u_.high(problem.dirichlet_dofs) = problem.dirichlet_values;
    result_.solver = name;
  }

  Solution solve() {
    for (int correction = 0;; ++correction) {
      const Eigen::VectorXd du = outer_step(exact_residual(problem_, u_, p_, contact_.lambda));
      const double largest = u_.high.lpNorm<Eigen::Infinity>(),
                   moved = du.lpNorm<Eigen::Infinity>();
      if (correction == 0) result_.penalised_max_u = largest;
      const double rho = contraction(moved);
      const double next = std::max(rho * moved, acceleration_.next_affine_image_step());
      ForwardError now = forward_error(problem_, u_, next, constraint_residual_, rho,
                                       result_.penalised_max_u, options_);
      // a load just above a force limit shows in the second residual, and not in the first
      if (correction == 0 && moved > 0 && problem_.bounds.has_force_limits()) now.relative = 1;
      result_.history.push_back(largest > 0 ? moved / largest : 0);
      result_.counters.corrections = correction;
      if (now.within(options_.tolerance) || correction >= options_.max_corrections ||
          !std::isfinite(moved))
        return finalise(now);
      const bool slow =
          correction % defaults::corrections_per_penalty == defaults::corrections_per_penalty - 1;
      if (slow)
        throw_if_infeasible(
            problem_, Eigen::VectorXd(problem_.m.cwiseProduct(problem_.b * u_.high)), u_.high,
            std::max(result_.penalised_max_u, largest) / std::sqrt(defaults::eps), result_);
      notify_or_throw(options_.progress,
                      {"corrections", correction + 1, now.relative, options_.tolerance},
                      result_.solver);
      // the u of the first correction is off by the factor's round-off, no image of p: a mix would
      // bring that back, again and again where p is round-off (the dependent rows of Duran and
      // Liberman's plate at t = 0)
      if (correction == 1) acceleration_.forget_the_oldest();
      acceleration_.mix(p_, u_);
      if (slow) reduce_penalty();
    }
  }

 private:
  /// Solves K du = r1 + delta^-1 B' M r2 + dlambda on the free unknowns, dp = (B du - r2) / delta,
  /// delta a row's penalty.
  Eigen::VectorXd outer_step(SplitResidual r) {
    const std::vector<int>&unknown = factor_.ordering().dof, &contact = problem_.bounds.unknowns;
    const Eigen::VectorXd& delta = factor_.penalties();
    if (p_.size() > 0) {
      const Eigen::VectorXd share =
          Eigen::VectorXd::Constant(delta.size(), factor_.delta())
              .cwiseQuotient(delta);  // 1 but where a row has its own penalty
      r.r1 += problem_.b.transpose() * problem_.m.cwiseProduct(r.r2).cwiseProduct(share) /
              factor_.delta();
    }
    const Eigen::VectorXd u_c = u_.high(contact), low_c = u_.low(contact);
    const Eigen::VectorXd found =
        contact_.lambda.size() > 0 ? contact_.lambda : Eigen::VectorXd::Zero(u_c.size());
    const ShiftedBounds bounds =
        ShiftedBounds(problem_.bounds.limits(), found).shifted_by(u_c).shifted_by(low_c);
    const BoundStatuses before = contact_.status;
    Eigen::VectorXd du = Eigen::VectorXd::Zero(problem_.size());
    du(unknown) = factor_.sparse_factor() != nullptr ? sparse_step(r.r1(unknown), bounds)
                                                     : schur_step(r.r1(unknown), bounds);
    u_ += du;
    const Eigen::VectorXd v = contact_.v.tail(bounds.count());
    for (int i = 0; i < bounds.count();
         ++i)  // an active value is that of its bound, to the last digit
      if (const BoundStatus status = contact_.status[i];
          is_active(status) && v(i) == bounds.prescribed(i, status))
        u_.set(contact[i], status == BoundStatus::at_lower ? problem_.bounds.lower(i)
                                                           : problem_.bounds.upper(i));
    if (p_.size() == 0) return du;
    const Eigen::VectorXd dp = (problem_.b * du - r.r2).cwiseQuotient(delta);
    p_ += dp;
    constraint_residual_ = (problem_.compliances() - delta).cwiseProduct(dp);
    if (contact_.status != before) acceleration_.restart();
    acceleration_.push(p_, dp, u_);
    return du;
  }

  void solve_contact_step(ContactSystem& system, const ShiftedBounds& bounds) {
    contact_ = contact_solver_(system, bounds, contact_, u_.high.lpNorm<Eigen::Infinity>());
    result_.counters.contact_iterations =
        std::max(result_.counters.contact_iterations, contact_.steps);
  }

  /// The contact problem condensed on the bounded unknowns, the last C places of the factor.
  Eigen::VectorXd schur_step(Eigen::VectorXd r, const ShiftedBounds& bounds) {
    const Eigen::Index c = bounds.count();
    Stopwatch watch;
    // the load on a bounded unknown itself stays out of the factor: a large load there, which the
    // bound carries, would leave its round-off on the neighbours
    const Eigen::VectorXd r_c = r.tail(c);
    r.tail(c).setZero();
    Eigen::VectorXd y = factor_.cholesky().forward(r);
    result_.seconds.solve += watch.lap();
    if (c > 0) {
      const auto l = factor_.contact_block().triangularView<Eigen::Lower>();
      const Eigen::VectorXd q = r_c + l * y.tail(c);
      SchurComplementContact system(factor_.schur(), q);
      solve_contact_step(system, bounds);
      y.tail(c) = l.transpose() * contact_.v;
      result_.seconds.contact += watch.lap();
    }
    Eigen::VectorXd du = factor_.cholesky().backward(std::move(y));
    result_.seconds.solve += watch.lap();
    return du;
  }

  /// The same on all free places.
  Eigen::VectorXd sparse_step(const Eigen::VectorXd& r, const ShiftedBounds& bounds) {
    const Stopwatch watch;
    std::vector<int> bounded(bounds.count());
    std::iota(bounded.begin(), bounded.end(), factor_.ordering().interior);
    SparseContact system(*factor_.sparse_factor(), r, std::move(bounded));
    solve_contact_step(system, bounds);
    result_.seconds.contact += watch.seconds();
    return contact_.v;
  }

  /// The factor by which a correction reduces the error of u: measured; at first, without B, the
  /// round-off of the factor.
  double contraction(double moved) const {
    if (p_.size() > 0) return acceleration_.contraction();
    if (result_.history.empty())
      return std::min(defaults::max_contraction, factor_roundoff(problem_, factor_));
    const double before = result_.history.back() * u_.high.lpNorm<Eigen::Infinity>();
    return moved < before ? std::clamp(moved / before, 1 - defaults::max_contraction,
                                       defaults::max_contraction)
                          : defaults::max_contraction;
  }

  /// Takes a penalty that is smaller, but no smaller than the compliance, nor so small that the
  /// factor keeps no digits of A1.
  void reduce_penalty() {
    const double before = factor_.delta();
    const double compliance = problem_.parametric_row_count() > 0 ? problem_.compliance : 0;
    const double smallest = defaults::round_off * stiffness_ratio(problem_).value();
    const double delta =
        std::max({before / defaults::penalty_reduction, compliance, std::min(before, smallest)});
    if (problem_.b.rows() == 0 || delta >= before) return;
    factor_.refactor(delta);
    acceleration_.restart();
  }

  /// u, p and lambda of the last correction, with the error and the warning. Throws NotConverged
  /// where the last correction is not small enough.
  Solution finalise(const ForwardError& now) {
    if (!now.within(options_.tolerance))
      throw NotConverged(
          fmt::format(
              "{}: not converged, or infeasible: after {} corrections the estimated relative "
              "error of u is {:.1e}, accepted {:.0e}, and compliance p = B u holds to {:.1e} "
              "of what is accepted",
              result_.solver, result_.counters.corrections, now.relative, options_.tolerance,
              now.constraint),
          std::max(now.relative, options_.tolerance * now.constraint),
          result_.counters.corrections);
    result_.counters.unknowns = problem_.free_count();
    result_.counters.factorisations = factor_.factorisations();
    result_.counters.solves = result_.counters.corrections + 1;
    result_.seconds.analyse = factor_.analyse_seconds();
    result_.seconds.factor = factor_.factor_seconds();
    for (const BoundStatus status : contact_.status) result_.active.push_back(is_active(status));
    result_.status = std::move(contact_.status);
    result_.u = std::move(u_.high);
    result_.p = std::move(p_.high);
    result_.lambda = contact_.lambda.size() > 0 ? contact_.lambda
                                                : Eigen::VectorXd::Zero(problem_.bounds.count());
    result_.error = now.absolute;  // absolute yet
    add_conditioning_error(problem_, factor_, constraint_residual_, result_);
    return std::move(result_);
  }

  const VariationalInequality& problem_;
  PenalisedCholesky& factor_;
  const ContactSolver& contact_solver_;
  const CorrectionOptions& options_;
  Solution result_;                      ///< what is counted
  DoubleDoubleVector u_, p_;             ///< N, R
  ContactResult contact_;                ///< of the last correction
  Eigen::VectorXd constraint_residual_;  ///< R, by the last correction
  Anderson acceleration_;
};

}  // namespace

Solution iterated_penalty(const VariationalInequality& problem, PenalisedCholesky& factor,
                          const ContactSolver& contact, const CorrectionOptions& options,
                          const std::string& name) {
  if (!(options.tolerance > 0))
    throw Error(fmt::format("{}: tolerance {}; accepted: above 0", name, options.tolerance));
  const SlackForm slack_form = factor.slack_form(problem);
  // corrections diverge where delta is below the compliance; it is 0 where the last factorisation
  // failed
  if (factor.delta() == 0 ||
      (slack_form->parametric_row_count() > 0 && factor.delta() < problem.compliance))
    factor.refactor(penalty_parameter(problem));
  Solution result = IteratedPenalty(*slack_form, factor, contact, options, name).solve();
  result.u.conservativeResize(problem.size());
  result.p.conservativeResize(problem.b.rows());
  result.lambda = slack_form.forces(std::move(result.lambda));
  if (result.error > 0)
    result.error = result.error / result.u.lpNorm<Eigen::Infinity>() + defaults::eps / 2;
  check_kkt(problem, result, {.fail = options.kkt_fail()});
  return result;
}

Solution active_set(const VariationalInequality& problem, PenalisedCholesky& factor,
                    const ActiveSetOptions& options) {
  const auto contact = [&](ContactSystem& system, const ShiftedBounds& bounds,
                           const ContactResult& before, double) {
    return solve_contact(system, bounds, before.status.empty() ? options.start : before.status,
                         options.max_contact_iterations);
  };
  return iterated_penalty(problem, factor, contact, options.corrections, "active set");
}

Solution active_set(const VariationalInequality& problem, const ActiveSetOptions& options) {
  PenalisedCholesky factor(problem, options.penalty, options.reduction);
  return active_set(problem, factor, options);
}

}  // namespace antilock
