#include "antilock/solve/active_set.hpp"

#include <algorithm>

#include "antilock/core/error.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/handed_back.hpp"

namespace antilock {

namespace {

Solution solve(const VariationalInequality& problem, PenaltyFactor& factor, const ActiveSetOptions& options) {
  if (options.start && options.start->active.size() != problem.contact.size())
    throw Error("active set: the start has " + std::to_string(options.start->active.size()) +
                " entries; accepted one per contact unknown, " + std::to_string(problem.contact.size()));
  if (options.start && !options.start->above.empty() && options.start->above.size() != problem.contact.size())
    throw Error("active set: the start has " + std::to_string(options.start->above.size()) +
                " entries for upper bounds; accepted none, or one per contact unknown");
  if (options.start && !options.start->beyond.empty() && options.start->beyond.size() != problem.contact.size())
    throw Error("active set: the start has " + std::to_string(options.start->beyond.size()) +
                " entries for bounds that give way; accepted none, or one per contact unknown");
  int most = 0;
  const auto start = [&](const auto& p, const ContactAnswer& before, int correction) {
    if (correction > 0) return held_by(before);
    return options.start ? *options.start : nested_start(p, options.max_steps);
  };
  const ContactSolver contact{
      .dense =
          [&](const ContactProblem& p, const ContactAnswer& before, int correction) {
            ContactAnswer answer = solve_contact(p, start(p, before, correction), options.max_steps);
            most = std::max(most, answer.steps);
            return answer;
          },
      .sparse =
          [&](const SparseContactProblem& p, const ContactAnswer& before, int correction) {
            SparseContactAnswer answer = solve_contact(p, start(p, before, correction), options.max_steps);
            most = std::max(most, answer.contact.steps);
            return answer;
          }};
  Solution solution = iterated_penalty(problem, factor, contact, options.corrections, "active set");
  solution.counters.contact = most;
  return solution;
}

}  // namespace

Solution active_set(const VariationalInequality& problem, PenaltyFactor& factor, const ActiveSetOptions& options) {
  require_bounds_on_unknowns(problem, "active set with a factor made before");
  factor.check_fits(problem);
  return solve(problem, factor, options);
}

Solution active_set(const VariationalInequality& problem, const ActiveSetOptions& options) {
  if (problem.combinations.rows() > 0) {
    check_data(problem);
    const BoundedUnknowns basis(problem);
    return handed_back(problem, basis, active_set(basis.problem, options),
                       TrustLevels{.refused = options.corrections.refused});
  }
  PenaltyFactor factor = PenaltyFactor::moderate(problem, options.penalty, options.road);
  return solve(problem, factor, options);
}

}  // namespace antilock
