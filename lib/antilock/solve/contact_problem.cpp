#include "antilock/solve/contact_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"

namespace antilock {
namespace {

/// What round-off makes of the two sides of the conditions: a sign below it is noise, and following it would only make
/// grazing or badly conditioned contact cycle.
struct Noise {
  Eigen::VectorXd v, lambda;  ///< C each
};

/// v on the inactive unknowns from the equation, lower on the active ones; lambda from both.
Noise solve_on(const ContactProblem& p, ContactAnswer& answer) {
  constexpr double unit = 64 * std::numeric_limits<double>::epsilon();
  std::vector<int> free, held;
  for (int i = 0; i < p.q.size(); ++i) (answer.active[i] ? held : free).push_back(i);
  answer.v = p.lower;
  const Eigen::VectorXd from = p.from.size() > 0 ? p.from : Eigen::VectorXd::Zero(p.q.size());
  // each bound by itself: an obstacle far away in one place must not hide contact in another
  Noise noise{p.noise.size() > 0 ? Eigen::VectorXd(unit * (from + p.lower).cwiseAbs() + p.noise)
                                 : Eigen::VectorXd(unit * (from + p.lower).cwiseAbs().cwiseMax(p.u_scale)),
              {}};
  if (!free.empty()) {
    Eigen::VectorXd rhs = p.q(free);
    if (!held.empty()) rhs.noalias() -= p.s(free, held) * p.lower(held);
    const Cholesky factor(p.s(free, free));
    if (!factor.positive_definite()) throw Error("contact: the Schur complement is not positive definite");
    const Eigen::VectorXd inactive = factor.solve(rhs);
    answer.v(free) = inactive;
    // a compliance is positive: forces of the size of their round-off, all of one sign, displace the most
    const Eigen::VectorXd residual_noise =
        unit * (p.s.diagonal().cwiseAbs().cwiseProduct((from + answer.v).cwiseAbs()) + p.q.cwiseAbs());
    const Eigen::VectorXd moved = factor.solve(Eigen::VectorXd(residual_noise(free))).cwiseAbs();
    noise.v(free) += moved;
  }
  // each force by its own row: one stiff unknown must not hide the pull on a soft one
  noise.lambda = unit * (p.s.cwiseAbs() * (from + answer.v).cwiseAbs() + p.q.cwiseAbs());
  answer.lambda.setZero(p.q.size());
  if (!held.empty()) answer.lambda(held) = p.s(held, Eigen::all) * answer.v - p.q(held);
  ++answer.steps;
  return noise;
}

/// Unknowns on the wrong side by more than noise.
std::vector<int> violations(const ContactProblem& p, const ContactAnswer& answer, const Noise& noise) {
  std::vector<int> wrong;
  for (int i = 0; i < p.q.size(); ++i)
    if (answer.active[i] ? answer.lambda(i) < -noise.lambda(i) : answer.v(i) - p.lower(i) < -noise.v(i))
      wrong.push_back(i);
  return wrong;
}

/// One step of Bertsekas' projected Newton method from a feasible v: it lowers the energy v' S v / 2 - q' v, so it
/// cannot cycle. Moves v and returns the contact set there.
std::vector<bool> projected_newton_set(const ContactProblem& p, Eigen::VectorXd& v, int& steps) {
  const Eigen::VectorXd gradient = p.s * v - p.q;
  std::vector<int> free;
  for (int i = 0; i < v.size(); ++i)
    if (v(i) > p.lower(i) || gradient(i) <= 0) free.push_back(i);
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(v.size());
  if (!free.empty()) {
    const Eigen::VectorXd step = Cholesky(p.s(free, free)).solve(Eigen::VectorXd(-gradient(free)));
    direction(free) = step;
  }
  ++steps;
  // Armijo along the projected path; the change of energy from the change of v, so that no digits cancel
  double t = 1;
  Eigen::VectorXd change;
  for (int halvings = 0; halvings < 60; ++halvings, t /= 2) {
    change = (v + t * direction).cwiseMax(p.lower) - v;
    if (change.dot(gradient + 0.5 * (p.s * change)) <= 1e-4 * change.dot(gradient)) break;
  }
  v += change;
  std::vector<bool> active(v.size());
  for (int i = 0; i < v.size(); ++i) active[i] = v(i) <= p.lower(i);
  return active;
}

}  // namespace

ContactAnswer solve_contact(const ContactProblem& problem, std::vector<bool> active, int max_steps) {
  ContactAnswer answer;
  answer.active = std::move(active);
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
      for (const int i : wrong) answer.active[i] = !answer.active[i];
    } else {
      if (descent.size() == 0) descent = answer.v.cwiseMax(problem.lower);
      answer.active = projected_newton_set(problem, descent, answer.steps);
    }
  }
}

std::vector<bool> nested_start(const ContactProblem& problem, int max_steps) {
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
  const ContactAnswer answer = solve_contact(smaller, nested_start(smaller, max_steps), max_steps);
  std::vector<bool> active(fine);
  for (Eigen::Index i = 0; i < fine; ++i) {
    const Eigen::Index right = std::min(i / 2, coarse - 1), left = std::max<Eigen::Index>((i - 1) / 2, 0);
    active[i] = answer.active[right] && answer.active[std::min(left, coarse - 1)];
  }
  return active;
}

}  // namespace antilock
