#include "antilock/solve/active_set.hpp"

#include <algorithm>

#include "antilock/core/error.hpp"

namespace antilock {

namespace {

Solution solve(const VariationalInequality& problem, PenaltyFactor& factor, const ActiveSetOptions& options) {
  if (options.start && options.start->size() != problem.contact.size())
    throw Error("active set: the start has " + std::to_string(options.start->size()) +
                " entries; accepted one a contact unknown, " + std::to_string(problem.contact.size()));
  int steps = 0, most = 0;
  const ContactSolver contact = [&](const ContactProblem& p, const ContactAnswer& before, int correction) {
    std::vector<bool> start = before.active;
    if (correction == 0) start = options.start ? *options.start : nested_start(p, options.max_steps);
    ContactAnswer answer = solve_contact(p, std::move(start), options.max_steps);
    steps += answer.steps;
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
  PenaltyFactor factor = PenaltyFactor::moderate(problem, options.penalty);
  return solve(problem, factor, options);
}

}  // namespace antilock
