// The contact loop: the primal-dual active set, with signs read above round-off (solve/active_set.hpp calls it).
#include "antilock/solve/contact_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"

namespace antilock {
namespace {

constexpr double unit = 64 * std::numeric_limits<double>::epsilon();

double upper_bound(const ContactProblem& p, int i) {
  return p.upper.size() > 0 ? p.upper(i) : std::numeric_limits<double>::infinity();
}
bool is_above(const std::vector<bool>& above, int i) { return !above.empty() && above[i]; }
bool is_equation(const ContactProblem& p, int i) { return p.lower(i) == upper_bound(p, i); }

/// What round-off makes of the two sides of the conditions: a sign below it is noise, and following it would only make
/// grazing or badly conditioned contact cycle.
struct Noise {
  Eigen::VectorXd v, lambda;  ///< C each; of v without what its bound brings in
};

/// Where v and the bound count from, and how large the bound is: each bound by itself, so that an obstacle far away in
/// one place hides no contact in another.
double noise_at(const ContactProblem& p, const Noise& noise, int i, double bound) {
  const double place = std::abs((p.from.size() > 0 ? p.from(i) : 0) + bound);
  return (p.noise.size() > 0 ? unit * place + p.noise(i) : unit * std::max(place, p.u_scale)) + noise.v(i);
}

/// v on the inactive unknowns from the equation, at its bound on the active ones; lambda from both.
Noise solve_on(const ContactProblem& p, ContactAnswer& answer) {
  std::vector<int> free, held;
  answer.v.resize(p.q.size());
  for (int i = 0; i < p.q.size(); ++i) {
    (answer.active[i] ? held : free).push_back(i);
    answer.v(i) = is_above(answer.above, i) ? p.upper(i) : p.lower(i);
  }
  const Eigen::VectorXd from = p.from.size() > 0 ? p.from : Eigen::VectorXd::Zero(p.q.size());
  Noise noise{Eigen::VectorXd::Zero(p.q.size()), {}};
  if (!free.empty()) {
    Eigen::VectorXd rhs = p.q(free);
    if (!held.empty()) rhs.noalias() -= p.s(free, held) * answer.v(held);
    const Cholesky factor(p.s(free, free));
    if (!factor.positive_definite()) throw Error("contact: the Schur complement is not positive definite");
    const Eigen::VectorXd inactive = factor.solve(rhs);
    answer.v(free) = inactive;
    // a compliance is positive: forces of the size of their round-off, all of one sign, displace the most
    const Eigen::VectorXd residual_noise =
        unit * (p.s.diagonal().cwiseAbs().cwiseProduct((from + answer.v).cwiseAbs()) + p.q.cwiseAbs());
    const Eigen::VectorXd moved = factor.solve(Eigen::VectorXd(residual_noise(free))).cwiseAbs();
    noise.v(free) = moved;
  }
  // each force by its own row: one stiff unknown must not hide the pull on a soft one
  noise.lambda = unit * (p.s.cwiseAbs() * (from + answer.v).cwiseAbs() + p.q.cwiseAbs());
  answer.lambda.setZero(p.q.size());
  if (!held.empty()) answer.lambda(held) = p.s(held, Eigen::all) * answer.v - p.q(held);
  ++answer.steps;
  return noise;
}

/// Whether unknown i is on the wrong side by more than noise. An equation holds whatever its force.
bool violated(const ContactProblem& p, const ContactAnswer& answer, const Noise& noise, int i) {
  if (!answer.active[i])
    return answer.v(i) - p.lower(i) < -noise_at(p, noise, i, p.lower(i)) ||
           upper_bound(p, i) - answer.v(i) < -noise_at(p, noise, i, upper_bound(p, i));
  const double push = is_above(answer.above, i) ? -answer.lambda(i) : answer.lambda(i);
  return push < -noise.lambda(i) && !is_equation(p, i);
}

std::vector<int> violations(const ContactProblem& p, const ContactAnswer& answer, const Noise& noise) {
  std::vector<int> wrong;
  for (int i = 0; i < p.q.size(); ++i)
    if (violated(p, answer, noise, i)) wrong.push_back(i);
  return wrong;
}

/// Puts i where its violated condition asks it to be. An unknown that is let go and, alone, would reach its other bound
/// goes there at once.
void exchange(const ContactProblem& p, ContactAnswer& answer, int i) {
  const double upper = upper_bound(p, i);
  const bool across = answer.active[i] && p.s(i, i) * (upper - p.lower(i)) < std::abs(answer.lambda(i));
  const bool above = answer.active[i] ? across && !is_above(answer.above, i) : answer.v(i) > upper;
  answer.active[i] = !answer.active[i] || across;
  if (p.upper.size() > 0) answer.above[i] = above;
}

/// The nearest v within the bounds.
Eigen::VectorXd projected(const ContactProblem& p, const Eigen::VectorXd& v) {
  return p.upper.size() > 0 ? Eigen::VectorXd(v.cwiseMax(p.lower).cwiseMin(p.upper)) : v.cwiseMax(p.lower);
}

/// One step of Bertsekas' projected Newton method from a feasible v: it lowers the energy v' S v / 2 - q' v, so it
/// cannot cycle. Moves v and returns the bounds that hold there.
HeldBounds projected_newton_set(const ContactProblem& p, Eigen::VectorXd& v, int& steps) {
  const Eigen::VectorXd gradient = p.s * v - p.q;
  std::vector<int> free;
  for (int i = 0; i < v.size(); ++i)
    if ((v(i) > p.lower(i) || gradient(i) <= 0) && (v(i) < upper_bound(p, i) || gradient(i) >= 0)) free.push_back(i);
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(v.size());
  if (!free.empty()) {
    const Eigen::VectorXd step = Cholesky(p.s(free, free)).solve(Eigen::VectorXd(-gradient(free)));
    direction(free) = step;
  }
  ++steps;
  // Armijo along the projected path; the change of energy from the change of v, so that no digits cancel
  double t = 1;
  Eigen::VectorXd next;
  for (int halvings = 0; halvings < 60; ++halvings, t /= 2) {
    next = projected(p, v + t * direction);
    const Eigen::VectorXd change = next - v;
    if (change.dot(gradient + 0.5 * (p.s * change)) <= 1e-4 * change.dot(gradient)) break;
  }
  v = next;
  HeldBounds held(std::vector<bool>(v.size()), std::vector<bool>(p.upper.size()));
  for (int i = 0; i < v.size(); ++i) {
    const bool above = v(i) >= upper_bound(p, i) && v(i) > p.lower(i);
    held.active[i] = v(i) <= p.lower(i) || above;
    if (p.upper.size() > 0) held.above[i] = above;
  }
  return held;
}

}  // namespace

ContactAnswer solve_contact(const ContactProblem& problem, HeldBounds start, int max_steps) {
  ContactAnswer answer;
  answer.active = std::move(start.active);
  answer.above = std::move(start.above);
  answer.above.resize(problem.upper.size());
  for (int i = 0; i < problem.q.size(); ++i) {  // a start asks for bounds that there are; an equation always holds
    const bool low = std::isfinite(problem.lower(i)), high = std::isfinite(upper_bound(problem, i));
    if (is_equation(problem, i)) answer.active[i] = true;
    if (problem.upper.size() > 0) answer.above[i] = answer.active[i] && high && (answer.above[i] || !low);
    answer.active[i] = answer.active[i] && (low || high);
  }
  std::size_t fewest = problem.q.size() + 1;
  int patience = 5;  // exchanges of whole sets allowed without progress before the energy is asked
  Eigen::VectorXd descent;
  while (true) {
    const Noise noise = solve_on(problem, answer);
    const std::vector<int> wrong = violations(problem, answer, noise);
    if (wrong.empty()) return answer;
    if (answer.steps >= max_steps)
      throw NotConverged(fmt::format("contact: {} of {} contact conditions still violated after {} steps", wrong.size(),
                                     problem.q.size(), answer.steps),
                         static_cast<double>(wrong.size()) / static_cast<double>(problem.q.size()), answer.steps);
    patience = wrong.size() < fewest ? 5 : patience - 1;
    fewest = std::min(fewest, wrong.size());
    if (patience > 0) {
      for (const int i : wrong) exchange(problem, answer, i);
    } else {
      if (descent.size() == 0) descent = projected(problem, answer.v);
      HeldBounds held = projected_newton_set(problem, descent, answer.steps);
      answer.active = std::move(held.active);
      answer.above = std::move(held.above);
    }
  }
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
  const ContactAnswer answer = solve_contact(smaller, nested_start(smaller, max_steps), max_steps);
  HeldBounds start(std::vector<bool>(fine), std::vector<bool>(problem.upper.size()));
  for (Eigen::Index i = 0; i < fine; ++i) {
    const Eigen::Index right = std::min(i / 2, coarse - 1), left = std::clamp<Eigen::Index>((i - 1) / 2, 0, coarse - 1);
    const bool above = is_above(answer.above, static_cast<int>(right));
    start.active[i] =
        answer.active[right] && answer.active[left] && is_above(answer.above, static_cast<int>(left)) == above;
    if (problem.upper.size() > 0) start.above[i] = start.active[i] && above;
  }
  return start;
}

}  // namespace antilock
