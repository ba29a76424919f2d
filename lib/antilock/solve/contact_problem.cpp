// The contact problem with a dense S. The loop itself is `settle` of contact_loop.hpp (solve/active_set.hpp calls it).
#include "antilock/solve/contact_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/solve/contact_loop.hpp"
#include "antilock/solve/projected_newton.hpp"

namespace antilock {
namespace {

constexpr double unit = 64 * std::numeric_limits<double>::epsilon();

/// The road of `settle` with a dense S.
class DenseRoad {
 public:
  DenseRoad(const ContactProblem& p, HeldBounds start)
      : p_(p),
        bounds_{p.lower, p.upper, p.most},
        from_(p.from.size() > 0 ? p.from : Eigen::VectorXd::Zero(p.q.size())),
        held_(bounds_.allowed(std::move(start))) {}

  int count() const { return bounds_.count(); }
  int steps() const { return steps_; }
  ContactAnswer answer() const { return {v_, lambda_, held_.active, steps_, held_.above, held_.beyond}; }

  /// v on the inactive unknowns from the equation, at its bound on the active ones; lambda from both.
  void solve() {
    std::vector<int> free, held;
    lambda_ = bounds_.given(held_);
    const Eigen::VectorXd q = p_.q + lambda_, size_q = p_.q.cwiseAbs() + lambda_.cwiseAbs();
    v_.resize(p_.q.size());
    for (int i = 0; i < count(); ++i) {
      (held_.active[i] ? held : free).push_back(i);
      v_(i) = bounds_.at(held_, i);
    }
    moved_.setZero(p_.q.size());
    if (!free.empty()) {
      Eigen::VectorXd rhs = q(free);
      if (!held.empty()) rhs.noalias() -= p_.s(free, held) * v_(held);
      const Cholesky factor(p_.s(free, free));
      if (!factor.positive_definite()) throw Error("contact: the Schur complement is not positive definite");
      const Eigen::VectorXd inactive = factor.solve(rhs);
      v_(free) = inactive;
      // a compliance is positive: forces of the size of their round-off, all of one sign, displace the most
      const Eigen::VectorXd residual_noise =
          unit * (p_.s.diagonal().cwiseAbs().cwiseProduct((from_ + v_).cwiseAbs()) + size_q);
      const Eigen::VectorXd moved = factor.solve(Eigen::VectorXd(residual_noise(free))).cwiseAbs();
      moved_(free) = moved;
    }
    // each force by its own row: one stiff unknown must not hide the pull on a soft one
    noise_lambda_ = unit * (p_.s.cwiseAbs() * (from_ + v_).cwiseAbs() + size_q);
    if (!held.empty()) lambda_(held) = p_.s(held, Eigen::all) * v_ - p_.q(held);
    ++steps_;
  }

  /// By more than noise: following a sign below it would only make grazing or badly conditioned contact cycle.
  bool violated(int i) const {
    if (held_.active[i]) {
      const auto [low, high] = bounds_.forces(held_, i);
      return lambda_(i) - low < -noise_lambda_(i) || high - lambda_(i) < -noise_lambda_(i);
    }
    const auto [low, high] = bounds_.piece(held_, i);
    return v_(i) - low < -noise_at(i, low) || high - v_(i) < -noise_at(i, high);
  }

  void exchange(int i) { bounds_.exchange(held_, i, v_(i), lambda_(i), p_.s(i, i)); }

  void descend() {
    if (descent_.size() == 0) descent_ = bounds_.nearest(v_);
    held_ = projected_newton_step(*this, descent_);
  }

  // of the projected Newton step
  Eigen::VectorXd times(const Eigen::VectorXd& v) const { return p_.s * v; }
  const Eigen::VectorXd& load() const { return p_.q; }
  auto places() const { return Eigen::seqN(0, count()); }
  const ContactBounds& bounds() const { return bounds_; }
  Eigen::VectorXd newton(const HeldBounds& pieces, const Eigen::VectorXd& gradient) {
    std::vector<int> free;
    for (int i = 0; i < count(); ++i)
      if (!pieces.active[i]) free.push_back(i);
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(count());
    if (!free.empty()) {
      const Eigen::VectorXd step = Cholesky(p_.s(free, free)).solve(Eigen::VectorXd(-gradient(free)));
      direction(free) = step;
    }
    ++steps_;
    return direction;
  }

 private:
  /// Where v and the bound count from, and how large the bound is: each bound by itself, so that an obstacle far away in
  /// one place hides no contact in another.
  double noise_at(int i, double bound) const {
    const double place = std::abs(from_(i) + bound);
    return (p_.noise.size() > 0 ? unit * place + p_.noise(i) : unit * std::max(place, p_.u_scale)) + moved_(i);
  }

  const ContactProblem& p_;
  const ContactBounds bounds_;
  const Eigen::VectorXd from_;  ///< C
  HeldBounds held_;
  Eigen::VectorXd v_, lambda_;            ///< C each
  Eigen::VectorXd moved_, noise_lambda_;  ///< C each, what round-off makes of v and of lambda
  Eigen::VectorXd descent_;               ///< C, the feasible v of the projected Newton steps; empty: none so far
  int steps_ = 0;
};

/// What every second one bears when the others bear nothing: its own, and half of what each neighbour gives up.
Eigen::VectorXd shared_by_every_second(const Eigen::VectorXd& most) {
  const Eigen::Index fine = most.size();
  Eigen::VectorXd shared(fine / 2);
  for (Eigen::Index i = 1; i < fine; i += 2) {
    shared(i / 2) = most(i);
    for (const Eigen::Index j : {i - 1, i + 1})
      if (j < fine && std::isfinite(most(j))) shared(i / 2) += 0.5 * most(j);
  }
  return shared;
}

}  // namespace

ContactAnswer solve_contact(const ContactProblem& problem, HeldBounds start, int max_steps) {
  DenseRoad road(problem, std::move(start));
  settle(road, max_steps);
  return road.answer();
}

HeldBounds nested_start(const ContactProblem& problem, int max_steps) {
  const Eigen::Index fine = problem.q.size();
  if (fine <= 8) return std::vector<bool>(fine, false);
  const Eigen::Index coarse = fine / 2;
  const auto kept = Eigen::seqN(1, coarse, 2), others = Eigen::seqN(0, fine - coarse, 2);
  const Cholesky factor(problem.s(others, others));
  if (!factor.positive_definite()) throw Error("contact: the Schur complement is not positive definite");
  const Eigen::MatrixXd half = factor.half_solve(Eigen::MatrixXd(problem.s(others, kept)));
  const Eigen::VectorXd half_q = factor.half_solve(Eigen::VectorXd(problem.q(others)));
  const Eigen::MatrixXd s = Eigen::MatrixXd(problem.s(kept, kept)) - half.transpose() * half;
  const Eigen::VectorXd q = Eigen::VectorXd(problem.q(kept)) - half.transpose() * half_q, lower = problem.lower(kept);
  ContactProblem smaller{s, q, lower, problem.u_scale};
  if (problem.from.size() > 0) smaller.from = problem.from(kept);
  if (problem.noise.size() > 0) smaller.noise = problem.noise(kept);
  if (problem.upper.size() > 0) smaller.upper = problem.upper(kept);
  if (problem.most.size() > 0) smaller.most = shared_by_every_second(problem.most);
  const ContactAnswer answer = solve_contact(smaller, nested_start(smaller, max_steps), max_steps);
  HeldBounds start(std::vector<bool>(fine), std::vector<bool>(problem.upper.size()),
                   std::vector<int>(problem.most.size()));
  for (Eigen::Index i = 0; i < fine; ++i) {
    const Eigen::Index right = std::min(i / 2, coarse - 1), left = std::clamp<Eigen::Index>((i - 1) / 2, 0, coarse - 1);
    const bool above = !answer.above.empty() && answer.above[right];
    const bool agree = answer.above.empty() || answer.above[left] == above;
    start.active[i] = answer.active[right] && answer.active[left] && agree;
    if (problem.upper.size() > 0) start.above[i] = start.active[i] && above;
    if (problem.most.size() > 0 && answer.beyond[right] == answer.beyond[left]) start.beyond[i] = answer.beyond[right];
  }
  return start;
}

}  // namespace antilock
