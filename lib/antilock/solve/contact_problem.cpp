#include "antilock/solve/contact_problem.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "antilock/scene/error.hpp"

namespace antilock {
namespace {

/// v on the inactive unknowns from the equation, lower on the active ones; lambda from both.
void solve_on(const ContactProblem& p, ContactAnswer& answer) {
  std::vector<int> free, held;
  for (int i = 0; i < p.q.size(); ++i) (answer.active[i] ? held : free).push_back(i);
  answer.v = p.lower;
  if (!free.empty()) {
    Eigen::VectorXd rhs = p.q(free);
    if (!held.empty()) rhs.noalias() -= p.s(free, held) * p.lower(held);
    const Eigen::LLT<Eigen::MatrixXd> factor(p.s(free, free));
    if (factor.info() != Eigen::Success) throw Error("contact: the Schur complement is not positive definite");
    const Eigen::VectorXd inactive = factor.solve(rhs);
    answer.v(free) = inactive;
  }
  answer.lambda.setZero(p.q.size());
  if (!held.empty()) answer.lambda(held) = p.s(held, Eigen::all) * answer.v - p.q(held);
  ++answer.steps;
}

/// Unknowns on the wrong side. Below `slack` (relative, a few thousand round-offs) a sign is noise, and following it
/// would only make grazing contact cycle.
std::vector<int> violations(const ContactProblem& p, const ContactAnswer& answer) {
  constexpr double slack = 1e-13;
  const double v_scale = std::max({answer.v.cwiseAbs().maxCoeff(), p.lower.cwiseAbs().maxCoeff(), p.u_scale});
  const double f_scale =
      std::max(p.q.cwiseAbs().maxCoeff(), (p.s.diagonal().cwiseAbs().array() * answer.v.array().abs()).maxCoeff());
  std::vector<int> wrong;
  for (int i = 0; i < p.q.size(); ++i)
    if (answer.active[i] ? answer.lambda(i) < -slack * f_scale : answer.v(i) - p.lower(i) < -slack * v_scale)
      wrong.push_back(i);
  return wrong;
}

/// Every second unknown and the straight lines between them, falling to zero at both ends.
Eigen::MatrixXd interpolation(Eigen::Index fine) {
  const Eigen::Index coarse = fine / 2;
  Eigen::MatrixXd p = Eigen::MatrixXd::Zero(fine, coarse);
  for (Eigen::Index c = 0; c < coarse; ++c) {
    p(2 * c + 1, c) = 1;
    p(2 * c, c) = 0.5;
    if (2 * c + 2 < fine) p(2 * c + 2, c) = 0.5;
  }
  return p;
}

}  // namespace

ContactAnswer solve_contact(const ContactProblem& problem, std::vector<bool> active, int max_steps) {
  ContactAnswer answer;
  answer.active = std::move(active);
  std::size_t fewest = problem.q.size() + 1;
  int patience = 10;  // whole-set exchanges allowed without progress before single pivots take over
  while (true) {
    solve_on(problem, answer);
    const std::vector<int> wrong = violations(problem, answer);
    if (wrong.empty()) return answer;
    if (answer.steps >= max_steps)
      throw NotConverged(fmt::format("contact: {} of {} contact conditions still violated after {} steps", wrong.size(),
                                     problem.q.size(), answer.steps),
                         static_cast<double>(wrong.size()) / static_cast<double>(problem.q.size()), answer.steps);
    if (wrong.size() < fewest) {
      fewest = wrong.size();
      patience = 10;
    } else {
      --patience;
    }
    if (patience > 0) {
      for (const int i : wrong) answer.active[i] = !answer.active[i];
    } else {
      answer.active[wrong.back()] = !answer.active[wrong.back()];  // Murty's rule: one index, always the last
    }
  }
}

std::vector<bool> nested_start(const ContactProblem& problem, int max_steps) {
  const Eigen::Index fine = problem.q.size();
  if (fine <= 8) return std::vector<bool>(fine, false);
  const Eigen::MatrixXd p = interpolation(fine);
  const Eigen::Index coarse = p.cols();
  // P' S P by the three entries of a column of P: quadratic work, not cubic
  const auto every_second = Eigen::seqN(1, coarse, 2);
  Eigen::MatrixXd sp = problem.s(Eigen::all, every_second) + 0.5 * problem.s(Eigen::all, Eigen::seqN(0, coarse, 2));
  const Eigen::Index inner = (fine - 1) / 2;  // columns of P that have a right neighbour
  sp.leftCols(inner) += 0.5 * problem.s(Eigen::all, Eigen::seqN(2, inner, 2));
  Eigen::MatrixXd psp = sp(every_second, Eigen::all) + 0.5 * sp(Eigen::seqN(0, coarse, 2), Eigen::all);
  psp.topRows(inner) += 0.5 * sp(Eigen::seqN(2, inner, 2), Eigen::all);

  const Eigen::VectorXd q = p.transpose() * problem.q, lower = problem.lower(every_second);
  const ContactProblem smaller{psp, q, lower, problem.u_scale};
  const ContactAnswer answer = solve_contact(smaller, nested_start(smaller, max_steps), max_steps);
  std::vector<bool> active(fine);
  for (Eigen::Index i = 0; i < fine; ++i) {
    const Eigen::Index right = std::min(i / 2, coarse - 1), left = std::max<Eigen::Index>((i - 1) / 2, 0);
    active[i] = answer.active[right] && answer.active[std::min(left, coarse - 1)];
  }
  return active;
}

}  // namespace antilock
