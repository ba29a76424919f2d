// The last question of the corrections: what in the answer is round-off, and what is a violation that something large
// elsewhere hides.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/problem/bounds.hpp"
#include "antilock/solve/corrections.hpp"

namespace antilock {
namespace {

constexpr double digits = 64 * std::numeric_limits<double>::epsilon();

/// How far each bounded value is outside its bounds, or, where the bound gives way, on the other side of it than its
/// force says.
Eigen::VectorXd sunk_in(const VariationalInequality& problem, const Eigen::VectorXd& u, const ContactAnswer& contact) {
  Eigen::VectorXd sunk = -slack(problem, u);
  const Eigen::VectorXd values = bounded_values(problem, u);
  for (Eigen::Index i = 0; i < problem.force_bound.size(); ++i) {
    if (std::isinf(problem.force_bound(i)) || contact.active[i] || contact.beyond[i] == 0) continue;
    sunk(i) = contact.beyond[i] < 0 ? values(i) - problem.lower(i) : problem.upper(i) - values(i);
  }
  return sunk;
}

}  // namespace

bool Corrections::hides_a_violation(const Change& change, const ContactSolver& contact) {
  const auto c = static_cast<Eigen::Index>(problem_.contact.size());
  const Eigen::VectorXd u_c = s_.u(problem_.contact), sunk = sunk_in(problem_, s_.u, contact_);
  // where u = 0 is admissible there is an answer, and the round-off of the largest u is none too large; else it may hide
  // that there is none
  const bool may_be_infeasible = problem_.compliance == 0 && problem_.b.rows() > 0 && !zero_is_admissible();
  const double plain = may_be_infeasible ? 0 : digits * s_.u.lpNorm<Eigen::Infinity>();
  bool suspect = false;
  if (options_.contact == 0)
    for (Eigen::Index i = 0; i < c; ++i) suspect = suspect || sunk(i) > plain + digits * std::abs(u_c(i));
  // a row of B is far from compliance p if what is left is no small part of its own terms
  Eigen::VectorXd left, terms;
  if (change.p.size() > 0 && problem_.compliance < factor_.delta()) {
    left = (factor_.delta() - problem_.compliance) * change.p.cwiseAbs();
    terms = problem_.b.cwiseAbs() * s_.u.cwiseAbs();
    suspect = suspect || (left.array() > 1e-4 * terms.array() + plain * row_sums_.array()).any();
  }
  if (!suspect) return false;
  // who asks for less than the default gets less, here as in `settled`
  const bool rough = options_.tolerance > CorrectionOptions{}.tolerance;

  note_round_off();
  Eigen::VectorXd noise = noise_.array() + 10 * options_.contact * s_.u.lpNorm<Eigen::Infinity>();
  const Eigen::VectorXd noise_c = noise(problem_.contact);
  for (Eigen::Index i = 0; i < c; ++i)  // a held unknown stands where its bound is
    if (contact_.active[i]) noise(problem_.contact[i]) = digits * std::abs(u_c(i));
  noise(problem_.fixed).setZero();
  const bool row = left.size() > 0 &&
                   (left.array() > 1e-4 * terms.array() + (problem_.b.cwiseAbs() * noise).array()).any() && !rough;
  const bool gap = options_.contact == 0 && (sunk.array() > noise_c.array()).any();
  if (gap) noise_c_ = noise_c;  // the contact problem sees finer from now on
  if (row || gap) return true;
  if (may_be_infeasible) require_an_admissible_u(contact);
  return false;
}

bool Corrections::drowned(const Change& change) {
  const std::size_t n = s_.history.size();
  const double u_now = s_.u.lpNorm<Eigen::Infinity>(), step = change.u.lpNorm<Eigen::Infinity>();
  if (n < 3 || u_now >= u_scale_ || s_.history[n - 1] < 0.5 * s_.history[n - 2]) return false;
  note_round_off();
  const double noise = noise_.lpNorm<Eigen::Infinity>();
  if (!(step <= noise && gap_ * u_scale_ <= noise)) return false;
  // where B is nearly dependent, u may come down slowly: not what the report would refuse
  report_conditions();
  if (worst_violation(s_.kkt) > options_.refused) return false;
  // a u below that round-off counts as 0, but what round-off a great load leaves may be far above that of u
  if (u_now > noise ? step > 1e-9 * u_now : u_now > 1e-15 * u_first_)
    s_.warning =
        fmt::format("{}: u is locked, {:.0e} of its size before; corrections move it by {:.0e} of itself still",
                    s_.solver, u_now / u_first_, step / u_now);
  return true;
}

bool Corrections::zero_is_admissible() const {
  return problem_.fixed_values.isZero(0) &&
         (slack(problem_, Eigen::VectorXd::Zero(problem_.size())).array() >= 0).all();
}

void Corrections::require_an_admissible_u(const ContactSolver& contact) {
  if (problem_.load.isZero(0)) return;
  VariationalInequality unloaded = problem_;
  unloaded.load.setZero();
  Corrections(unloaded, factor_, options_, s_.solver).solve(contact);
}

void Corrections::note_round_off() {
  Eigen::VectorXd forces = problem_.load.cwiseAbs() + problem_.a1.cwiseAbs() * s_.u.cwiseAbs();
  if (problem_.b.rows() > 0) forces += problem_.b.cwiseAbs().transpose() * problem_.m.cwiseProduct(s_.p.cwiseAbs());
  for (std::size_t i = 0; i < problem_.contact.size(); ++i)  // what the obstacle bears displaces nothing
    if (contact_.active[i]) forces(problem_.contact[i]) = 0;
  const Eigen::VectorXd on_free = digits * forces(factor_.numbering().unknown);
  const Eigen::VectorXd displaced = factor_.solve(on_free);
  Eigen::VectorXd noise = Eigen::VectorXd::Zero(problem_.size());
  noise(factor_.numbering().unknown) = displaced.cwiseAbs();
  noise_ = noise_.size() > 0 ? Eigen::VectorXd(noise_.cwiseMin(noise)) : noise;
}

}  // namespace antilock
