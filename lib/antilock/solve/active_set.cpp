#include "antilock/solve/active_set.hpp"

#include <algorithm>

#include "antilock/core/error.hpp"

namespace antilock {

namespace {

Solution solve(const VariationalInequality& problem, PenaltyFactor& factor, const ActiveSetOptions& options) {
  int most = 0;
  const auto contact = [&](const ContactQuestion& asked) {
    const std::optional<Pieces> before(asked.before.pieces);
    ContactAnswer answer =
        solve_contact(asked.system, asked.stairs, before->empty() ? options.start : before, options.max_steps);
    most = std::max(most, answer.steps);
    return answer;
  };
  Solution solution = iterated_penalty(problem, factor, contact, options.corrections, "active set");
  solution.counters.contact = most;
  return solution;
}

}  // namespace

Solution active_set(const VariationalInequality& problem, PenaltyFactor& factor, const ActiveSetOptions& options) {
  factor.check_fits(problem);
  return solve(problem, factor, options);
}

Solution active_set(const VariationalInequality& problem, const ActiveSetOptions& options) {
  PenaltyFactor factor(problem, options.penalty, options.road);
  return solve(problem, factor, options);
}

}  // namespace antilock
