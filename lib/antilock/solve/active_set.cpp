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
#include "antilock/solve/detail/tied.hpp"
#include "antilock/solve/judge.hpp"
#include "antilock/solve/kkt.hpp"
#include "antilock/solve/residual.hpp"
#include "antilock/solve/tuned.hpp"

namespace antilock {
namespace {

/// One solve: the factor and where the iterates stand.
class IteratedPenalty {
 public:
  IteratedPenalty(const VariationalInequality& problem, PenaltyFactor& factor, const ContactSolver& contact,
                  const CorrectionOptions& options, const std::string& name)
      : problem_(problem),
        factor_(factor),
        contact_solver_(contact),
        options_(options),
        u_(Eigen::VectorXd::Zero(problem.size())),
        p_(Eigen::VectorXd::Zero(problem.b.rows())) {
    u_.high(problem.fixed) = problem.fixed_values;
    s_.solver = name;
  }

  Solution solve() {
    for (int correction = 0;; ++correction) {
      const Eigen::VectorXd du = correct(exact_residual(problem_, u_, p_, contact_.lambda));
      const double largest = u_.high.lpNorm<Eigen::Infinity>(), moved = du.lpNorm<Eigen::Infinity>();
      if (correction == 0) s_.moderate = largest;
      const double rho = rate(moved), next = std::max(rho * moved, acceleration_.next_companion_step());
      ForwardError now = accuracy(problem_, u_, next, left_of_r2_, rho, s_.moderate, options_);
      // what is left of a load that a bound can hardly bear is seen by the second residual, and not by the first
      if (correction == 0 && moved > 0 && problem_.force_bound.size() > 0) now.error = 1;
      s_.history.push_back(largest > 0 ? moved / largest : 0);
      s_.counters.corrections = correction;
      if (now.within(options_.tolerance) || correction >= options_.max_corrections || !std::isfinite(moved))
        return finished(now);
      const bool slow = correction % tuned::corrections_per_penalty == tuned::corrections_per_penalty - 1;
      if (slow)
        require_an_admissible_u(problem_, Eigen::VectorXd(problem_.m.cwiseProduct(problem_.b * u_.high)), u_.high,
                                std::max(s_.moderate, largest) / std::sqrt(tuned::eps), s_);
      report(options_.progress, {"corrections", correction + 1, now.error, options_.tolerance}, s_.solver);
      // the u of the first correction is off by the factor's round-off, no image of p: a mix would bring that back,
      // again and again where p is round-off (the dependent rows of Duran and Liberman's plate at t = 0)
      if (correction == 1) acceleration_.forget_the_oldest();
      acceleration_.mix(p_, u_);
      if (slow) take_a_smaller_penalty();
    }
  }

 private:
  /// K du = r1 + delta^-1 B' M r2 + dlambda on the free places, dp = (B du - r2) / delta, delta a row's penalty.
  Eigen::VectorXd correct(SplitResidual r) {
    const std::vector<int>&unknown = factor_.numbering().unknown, &contact = problem_.contact;
    const Eigen::VectorXd& delta = factor_.penalties();
    if (p_.size() > 0) {
      const Eigen::VectorXd share = Eigen::VectorXd::Constant(delta.size(), factor_.delta())
                                        .cwiseQuotient(delta);  // 1 but where a row has its own penalty
      r.r1 += problem_.b.transpose() * problem_.m.cwiseProduct(r.r2).cwiseProduct(share) / factor_.delta();
    }
    const Eigen::VectorXd u_c = u_.high(contact), low_c = u_.low(contact);
    const Stairs stairs =
        Stairs{problem_.lower, problem_.upper, problem_.force_bound, contact_.lambda}.from(u_c).from(low_c);
    const Pieces before = contact_.pieces;
    Eigen::VectorXd du = Eigen::VectorXd::Zero(problem_.size());
    du(unknown) = factor_.held() != nullptr ? sparse_road(r.r1(unknown), stairs) : dense_road(r.r1(unknown), stairs);
    u_ += du;
    const Eigen::VectorXd v = contact_.v.tail(stairs.count());
    for (int i = 0; i < stairs.count(); ++i)  // what is held stands where its bound is, to the last digit
      if (const Piece piece = contact_.pieces[i]; is_active(piece) && v(i) == stairs.given(i, piece))
        u_.set(contact[i], piece == Piece::at_lower ? problem_.lower(i) : problem_.upper(i));
    if (p_.size() == 0) return du;
    const Eigen::VectorXd dp = (problem_.b * du - r.r2).cwiseQuotient(delta);
    p_ += dp;
    left_of_r2_ = (problem_.compliances() - delta).cwiseProduct(dp);
    if (contact_.pieces != before) acceleration_.restart();
    acceleration_.note(p_, dp, u_);
    return du;
  }

  void ask(ContactSystem& system, const Stairs& stairs) {
    contact_ = contact_solver_(system, stairs, contact_, u_.high.lpNorm<Eigen::Infinity>());
    s_.counters.contact = std::max(s_.counters.contact, contact_.steps);
  }

  /// The contact problem condensed on the bounded unknowns, the last C places of the factor.
  Eigen::VectorXd dense_road(Eigen::VectorXd r, const Stairs& stairs) {
    const Eigen::Index c = stairs.count();
    Stopwatch watch;
    // what acts on a bounded unknown itself stays out of the factor: a great load there, which the bound bears, would
    // leave its round-off on the neighbours
    const Eigen::VectorXd r_c = r.tail(c);
    r.tail(c).setZero();
    Eigen::VectorXd y = factor_.dense().forward(r);
    s_.seconds.solve += watch.lap();
    if (c > 0) {
      const auto l = factor_.contact_block().triangularView<Eigen::Lower>();
      const Eigen::VectorXd q = r_c + l * y.tail(c);
      DenseContact system(factor_.schur(), q);
      ask(system, stairs);
      y.tail(c) = l.transpose() * contact_.v;
      s_.seconds.contact += watch.lap();
    }
    Eigen::VectorXd du = factor_.dense().backward(std::move(y));
    s_.seconds.solve += watch.lap();
    return du;
  }

  /// The same on all free places.
  Eigen::VectorXd sparse_road(const Eigen::VectorXd& r, const Stairs& stairs) {
    const Stopwatch watch;
    std::vector<int> bounded(stairs.count());
    std::iota(bounded.begin(), bounded.end(), factor_.numbering().interior);
    SparseContact system(*factor_.held(), r, std::move(bounded));
    ask(system, stairs);
    s_.seconds.contact += watch.seconds();
    return contact_.v;
  }

  /// By how much a correction brings u closer: as the past tells; at first, without B, the round-off of the factor.
  double rate(double moved) const {
    if (p_.size() > 0) return acceleration_.contraction();
    if (s_.history.empty()) return std::min(tuned::slowest, rounding_of_the_factor(problem_, factor_));
    const double before = s_.history.back() * u_.high.lpNorm<Eigen::Infinity>();
    return moved < before ? std::clamp(moved / before, 1 - tuned::slowest, tuned::slowest) : tuned::slowest;
  }

  /// No smaller than the compliance, and than what leaves a factor digits of A1.
  void take_a_smaller_penalty() {
    const double before = factor_.delta(), compliance = problem_.class_rows() > 0 ? problem_.compliance : 0;
    const double smallest = tuned::round_off * relative_stiffness(problem_).value();
    const double delta = std::max({before / tuned::next_penalty, compliance, std::min(before, smallest)});
    if (problem_.b.rows() == 0 || delta >= before) return;
    factor_.refactor(delta);
    acceleration_.restart();
  }

  /// u, p and lambda of the last correction, with its error and the judge's doubt. Throws NotConverged where the last
  /// correction is not small enough.
  Solution finished(const ForwardError& now) {
    if (!now.within(options_.tolerance))
      throw NotConverged(fmt::format("{}: not converged, or infeasible: after {} corrections the estimated relative "
                                     "error of u is {:.1e}, accepted {:.0e}, and compliance p = B u holds to {:.1e} "
                                     "of what is accepted",
                                     s_.solver, s_.counters.corrections, now.error, options_.tolerance, now.open),
                         std::max(now.error, options_.tolerance * now.open), s_.counters.corrections);
    s_.counters.unknowns = problem_.free_count();
    s_.counters.factorisations = factor_.factorisations();
    s_.counters.solves = s_.counters.corrections + 1;
    s_.seconds.analyse = factor_.analyse_seconds();
    s_.seconds.factor = factor_.factor_seconds();
    for (const Piece piece : contact_.pieces) s_.active.push_back(is_active(piece));
    s_.pieces = std::move(contact_.pieces);
    s_.u = std::move(u_.high);
    s_.p = std::move(p_.high);
    s_.lambda = contact_.lambda.size() > 0 ? contact_.lambda : Eigen::VectorXd::Zero(problem_.bound_count());
    s_.error = now.off;  // absolute yet
    doubt(problem_, factor_, left_of_r2_, s_);
    return std::move(s_);
  }

  const VariationalInequality& problem_;
  PenaltyFactor& factor_;
  const ContactSolver& contact_solver_;
  const CorrectionOptions& options_;
  Solution s_;                  ///< what is counted
  Twice u_, p_;                 ///< N, R
  ContactAnswer contact_;       ///< of the last correction
  Eigen::VectorXd left_of_r2_;  ///< R, by the last correction
  Anderson acceleration_;
};

}  // namespace

Solution iterated_penalty(const VariationalInequality& problem, PenaltyFactor& factor, const ContactSolver& contact,
                          const CorrectionOptions& options, const std::string& name) {
  if (!(options.tolerance > 0))
    throw Error(fmt::format("{}: tolerance {}; accepted: above 0", name, options.tolerance));
  const Tied tied = factor.tied(problem);
  // corrections diverge where delta is below the compliance; it is 0 where the last factorisation failed
  if (factor.delta() == 0 || (tied->class_rows() > 0 && factor.delta() < problem.compliance))
    factor.refactor(moderate_delta(problem));
  Solution answer = IteratedPenalty(*tied, factor, contact, options, name).solve();
  answer.u.conservativeResize(problem.size());
  answer.p.conservativeResize(problem.b.rows());
  answer.lambda = tied.forces(std::move(answer.lambda));
  if (answer.error > 0) answer.error = answer.error / answer.u.lpNorm<Eigen::Infinity>() + tuned::eps / 2;
  check_kkt(problem, answer, {.refused = options.refused()});
  return answer;
}

Solution active_set(const VariationalInequality& problem, PenaltyFactor& factor, const ActiveSetOptions& options) {
  const auto contact = [&](ContactSystem& system, const Stairs& stairs, const ContactAnswer& before, double) {
    return solve_contact(system, stairs, before.pieces.empty() ? options.start : before.pieces, options.max_steps);
  };
  return iterated_penalty(problem, factor, contact, options.corrections, "active set");
}

Solution active_set(const VariationalInequality& problem, const ActiveSetOptions& options) {
  PenaltyFactor factor(problem, options.penalty, options.road);
  return active_set(problem, factor, options);
}

}  // namespace antilock
