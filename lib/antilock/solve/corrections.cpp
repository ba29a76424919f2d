#include "antilock/solve/corrections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/solve/dependent_rows.hpp"

namespace antilock {
namespace {

/// A u that falls below this fraction of its size after the first correction is locked: its round-off, 1e-16 of that
/// size, is what the default tolerance of 1e-10 comes to.
constexpr double locked = 1e-5;
/// A u above this multiple of it runs away: no u meets the bounds and B u = 0. A stiffer problem does not move further
/// than the moderate one, and of a u of 1e18 every condition would hold, relative to it.
constexpr double runaway = 1e8;

}  // namespace

Solution Corrections::solve(const ContactSolver& contact) {
  for (;; ++correction_) {
    if (correction_ > options_.max_corrections)
      throw NotConverged(
          fmt::format("{}: not converged, or infeasible: after {} corrections the estimated relative error of u is "
                      "{:.1e} and compliance p = B u holds to {:.1e}, accepted {:.0e}",
                      s_.solver, correction_ - 1, error_, gap_, options_.tolerance),
          std::max(error_, gap_), correction_ - 1);
    rescue();
    const Change change = correct(residual(), contact);
    if ((settled(change) || drowned(change)) && !hides_a_violation(change, contact)) return finished();
    report(options_.progress, {"corrections", correction_ + 1, error_, options_.tolerance}, s_.solver);
    accelerate();
  }
}

SplitResidual Corrections::residual() const {
  if (correction_ == 0 && s_.u.isZero(0)) return {problem_.load, Eigen::VectorXd::Zero(problem_.b.rows())};
  // with the contact forces so far: where they are far above the load, r without them would keep none of its digits
  return long_double_ ? extended_residual(problem_, s_.u, s_.p, contact_.lambda)
                      : split_residual(problem_, s_.u, s_.p, contact_.lambda);
}

Corrections::Change Corrections::correct(SplitResidual r, const ContactSolver& contact) {
  const double delta = factor_.delta();
  const bool stiff = problem_.b.rows() > 0;
  if (stiff && !r.r2.isZero(0)) r.r1.noalias() += problem_.b.transpose() * (problem_.m.cwiseProduct(r.r2) / delta);
  const HeldBounds before = held_by(contact_);
  Change change;
  change.u = solve_with_factor(r.r1(factor_.numbering().unknown), contact);
  s_.u += change.u;
  if (stiff) {
    change.p = (problem_.b * change.u - r.r2) / delta;
    s_.p += change.p;
  }
  change.same_contact =
      contact_.active == before.active && contact_.above == before.above && contact_.beyond == before.beyond;
  return change;
}

Eigen::VectorXd Corrections::solve_with_factor(Eigen::VectorXd r, const ContactSolver& contact) {
  const auto c = static_cast<Eigen::Index>(problem_.contact.size());
  if (factor_.held() != nullptr) return solve_holding(std::move(r), contact);
  Stopwatch watch;
  // what acts on Gamma_C itself stays out of the factor: a great load there, which the obstacle bears, would leave
  // its round-off on the neighbours
  const Eigen::VectorXd r_c = r.tail(c);
  r.tail(c).setZero();
  Eigen::VectorXd y = factor_.forward(r);
  s_.seconds.solve += watch.lap();
  if (c > 0) {
    // r_c + L_C y_C is the residual condensed on Gamma_C; v = du_C counts from u_C, so that no S u_C brings its
    // round-off in
    const auto l = factor_.contact_block().triangularView<Eigen::Lower>();
    const Eigen::VectorXd u_c = s_.u(problem_.contact), lower = problem_.lower - u_c;
    const Eigen::VectorXd upper = problem_.upper.size() > 0 ? Eigen::VectorXd(problem_.upper - u_c) : Eigen::VectorXd();
    Eigen::VectorXd q = r_c + l * y.tail(c);
    if (contact_.lambda.size() > 0) q -= contact_.lambda;  // r holds them already; contact asks for all
    contact_ =
        contact.dense({schur_, q, lower, s_.u.lpNorm<Eigen::Infinity>(), u_c, noise_c_, upper, problem_.force_bound},
                      contact_, correction_);
    y.tail(c) = l.transpose() * contact_.v;
    s_.seconds.contact += watch.lap();
  }
  const Eigen::VectorXd x = factor_.backward(std::move(y));
  Eigen::VectorXd du = Eigen::VectorXd::Zero(problem_.size());
  du(factor_.numbering().unknown) = x;
  s_.seconds.solve += watch.lap();
  return du;
}

Eigen::VectorXd Corrections::solve_holding(Eigen::VectorXd r, const ContactSolver& contact) {
  const Stopwatch watch;
  const std::vector<int>& unknown = factor_.numbering().unknown;
  std::vector<int> bounded(problem_.contact.size());
  std::iota(bounded.begin(), bounded.end(), factor_.numbering().interior);
  const Eigen::VectorXd from = s_.u(unknown), u_c = s_.u(problem_.contact), lower = problem_.lower - u_c;
  const Eigen::VectorXd upper = problem_.upper.size() > 0 ? Eigen::VectorXd(problem_.upper - u_c) : Eigen::VectorXd();
  if (contact_.lambda.size() > 0) r.tail(contact_.lambda.size()) -= contact_.lambda;  // contact asks for all
  SparseContactAnswer answer = contact.sparse(
      {*factor_.held(), r, bounded, lower, s_.u.lpNorm<Eigen::Infinity>(), from, noise_c_, upper, problem_.force_bound},
      contact_, correction_);
  contact_ = std::move(answer.contact);
  ++factor_.solves;
  Eigen::VectorXd du = Eigen::VectorXd::Zero(problem_.size());
  du(unknown) = answer.x;
  s_.seconds.contact += watch.seconds();
  return du;
}

bool Corrections::settled(const Change& change) {
  const bool stiff = problem_.b.rows() > 0;
  const double before = s_.history.empty() ? 0 : s_.history.back();
  // a locked u tends to 0, and its round-off is that of the first; one on its way to infinity (an infeasible problem)
  // must not count for long
  if (correction_ == 0) u_first_ = s_.u.lpNorm<Eigen::Infinity>();
  const double u = s_.u.lpNorm<Eigen::Infinity>();
  u_scale_ = std::max(locked * u_first_, u);
  const double step = u_scale_ > 0 ? change.u.lpNorm<Eigen::Infinity>() / u_scale_ : 0;
  s_.history.push_back(step);
  if (!std::isfinite(step))
    throw NotConverged(s_.solver + ": the iterated penalty broke down (not a number)", step, correction_);
  if (u_scale_ == 0 || (!stiff && !long_double_)) return true;  // without B, K is A1: the first solve is the answer
  // what compliance p - B u comes to now: where no u meets the bounds and B u = 0, u settles and this does not
  gap_ = std::abs(problem_.compliance - factor_.delta()) * change.p.cwiseQuotient(row_sums_).lpNorm<Eigen::Infinity>() /
         u_scale_;
  if (!change.same_contact) acceleration_.restart();
  if (stiff) acceleration_.note(s_.p, change.p, s_.u);
  if (correction_ == 0) return false;
  // du contracts like the error, and the error left behind is du rate / (1 - rate). A mix makes du smaller than its own
  // contraction would: the rate is that of the plain corrections, which the past still tells.
  const double rate =
      stiff ? acceleration_.contraction() : std::clamp(step < before ? step / before : 0.99, 0.01, 0.99);
  error_ = step * rate / (1 - rate);
  return error_ <= options_.tolerance && gap_ <= 1e-3 * options_.tolerance;
}

void Corrections::accelerate() { acceleration_.mix(s_.p, s_.u); }

void Corrections::report_conditions() {
  if (contact_.lambda.size() > 0) s_.lambda = contact_.lambda;
  s_.moderate = u_first_;
  s_.kkt = kkt_report_unchecked(problem_, s_);
}

Solution Corrections::finished() {
  // asked of the answer alone: on its way there the mix may pass through any size
  if (const double u = s_.u.lpNorm<Eigen::Infinity>(); u_first_ > 0 && u > runaway * u_first_)
    throw NotConverged(fmt::format("{}: not converged, or infeasible: after {} corrections u is {:.0e} times its size "
                                   "with the moderate penalty, accepted {:.0e}",
                                   s_.solver, correction_, u / u_first_, runaway),
                       u / u_first_, correction_);
  s_.counters.corrections = correction_;
  s_.counters.unknowns = problem_.free_count();
  s_.counters.factorisations = factor_.factorisations;
  if (factor_.held() != nullptr) s_.counters.factorisations += factor_.held()->refactorisations;
  s_.counters.solves = factor_.solves - s_.counters.solves;  // since the start
  s_.seconds.analyse = factor_.analyse_seconds;
  s_.seconds.factor = factor_.factor_seconds;
  s_.active = contact_.active;
  const std::string drowned = s_.warning;
  report_conditions();
  require_trusted(s_, TrustLevels{.refused = options_.refused});
  if (s_.warning.empty()) s_.warning = drowned;
  const auto apart = problem_.compliance == 0 ? nearly_dependent_rows(problem_) : std::nullopt;
  if (apart && s_.warning.empty())
    s_.warning = fmt::format(
        "{}: rows of B are {:.0e} from dependent, trusted 3e-9 and more, or 1e-14 and less (equal)", s_.solver, *apart);
  return std::move(s_);
}

}  // namespace antilock
