#include "antilock/solve/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

/// A bound whose value or force is outside the range of its status: a force by more than round-off,
/// a value by anything. (A value that is outside by round-off costs one step of the search, which
/// stays finite. Bounds whose forces are 0 but for round-off would be released in ever other sets.)
struct Breakpoint {
  int bound;
  BoundStatus next_status;  ///< beyond the end of the range
  double value;             ///< the end of the range
  double step{};            ///< the fraction of the search direction after which the value is there
};

FixedStatusSolution solve_with_fixed_status(ContactSystem& system, const ShiftedBounds& bounds,
                                            const BoundStatuses& status) {
  std::vector<char> active(status.size());
  Eigen::VectorXd prescribed(bounds.count());
  for (int i = 0; i < bounds.count(); ++i) {
    active[i] = is_active(status[i]) ? 1 : 0;
    prescribed(i) = bounds.prescribed(i, status[i]);
  }
  return system.solve(active, prescribed);
}

/// The active bounds whose forces are outside their ranges, or (`active` = false) the others whose
/// values are.
std::vector<Breakpoint> violations(const ShiftedBounds& bounds, const BoundStatuses& status,
                                   const FixedStatusSolution& now, const std::vector<int>& dof_of,
                                   bool active) {
  std::vector<Breakpoint> violations;
  for (int i = 0; i < bounds.count(); ++i) {
    if (is_active(status[i]) != active) continue;
    const double value = active ? now.lambda(i) : now.v(dof_of[i]);
    const auto [low, high] = bounds.admissible_range(i, status[i]);
    const double tolerance = active ? now.round_off(i) : 0;
    const bool under = value<low - tolerance, over = value> high + tolerance;
    if (under || over)  // too small a force: v must grow
      violations.push_back({i, bounds.next(i, status[i], active == under), under ? low : high});
  }
  return violations;
}

/// Moves v towards w, as far as contact.hpp says; the bounds of `breakpoints` that are met change
/// their status.
void projected_search(const ContactSystem& system, std::vector<Breakpoint>& breakpoints,
                      const Eigen::VectorXd& w, Eigen::VectorXd& v, BoundStatuses& status) {
  const Eigen::VectorXd direction = w - v;
  const std::vector<int>& dof_of = system.bounded();
  for (Breakpoint& b : breakpoints) {
    const double full = direction(dof_of[b.bound]);
    const double step = (b.value - v(dof_of[b.bound])) / full;
    b.step = full != 0 && step > 0 ? std::min(step, 1.0)
                                   : 0;  // 0 where it is not a number, so that the loop ends
  }
  std::sort(breakpoints.begin(), breakpoints.end(),
            [](const Breakpoint& a, const Breakpoint& b) { return a.step < b.step; });
  const double first = breakpoints.front().step;
  const double at_first = (1 - first) * (1 - first) * system.energy_norm_squared(direction);
  Eigen::VectorXd next;
  double step = 1;
  for (std::size_t stopped = breakpoints.size();; step = breakpoints[stopped - 1].step) {
    next = v + step * direction;
    for (const Breakpoint& b : breakpoints)
      if (b.step <= step) next(dof_of[b.bound]) = b.value;
    if (step == first || system.energy_norm_squared(w - next) < at_first) break;
    stopped = std::max<std::size_t>(stopped / 2, 1);
  }
  for (const Breakpoint& b : breakpoints)
    if (b.step <= step) status[b.bound] = b.next_status;
  v = std::move(next);
}

}  // namespace

ContactResult solve_contact(ContactSystem& system, const ShiftedBounds& bounds,
                            const std::optional<BoundStatuses>& start, int max_iterations) {
  BoundStatuses status =
      bounds.nearest_valid(start ? *start : system.nested_start(bounds, max_iterations));
  std::set<BoundStatuses> visited_faces;  // whose minimisers were feasible
  Eigen::VectorXd v;
  for (int steps = 1;; ++steps) {
    FixedStatusSolution now = solve_with_fixed_status(system, bounds, status);
    std::vector<Breakpoint> violated = violations(bounds, status, now, system.bounded(), false);
    const bool feasible = violated.empty();
    if (feasible) violated = violations(bounds, status, now, system.bounded(), true);
    if (violated.empty() || (feasible && !visited_faces.insert(status).second)) {
      for (int i = 0; i < bounds.count(); ++i)
        now.lambda(i) = bounds.total_force(i, status[i], now.lambda(i));
      return {std::move(now.v), std::move(now.lambda), std::move(status), steps};
    }
    if (steps >= max_iterations)
      throw NotConverged(
          fmt::format("contact: {} of {} contact conditions still violated after {} steps",
                      violated.size(), bounds.count(), steps),
          static_cast<double>(violated.size()) / bounds.count(), steps);
    if (feasible) {
      for (const Breakpoint& b : violated) status[b.bound] = b.next_status;  // released
      v = std::move(now.v);
      continue;
    }
    if (v.size() == 0)
      v = now.v;  // the first direction is 0: every violated value moves to its bound
    projected_search(system, violated, now.v, v, status);
  }
}

BoundStatuses coarse_start(const ShiftedBounds& bounds, ContactSystem& coarse, int max_iterations) {
  const int count = bounds.count();
  const auto every_second = [](const Eigen::VectorXd& of_all) {
    return Eigen::VectorXd(of_all(Eigen::seqN(1, of_all.size() / 2, 2)));
  };
  ShiftedBounds fewer(BoundLimits(every_second(bounds.lower), every_second(bounds.upper),
                                  every_second(bounds.force_limit)),
                      every_second(bounds.multiplier_estimate));
  // a bound carries its own force, and half of that of each neighbour that is left out
  for (int i = 0; i < count; i += 2)
    for (const int neighbour : {i / 2 - 1, i / 2})
      if (neighbour >= 0 && neighbour < fewer.count() && std::isfinite(bounds.force_limit(i)))
        fewer.force_limit(neighbour) += 0.5 * bounds.force_limit(i);
  const BoundStatuses status = solve_contact(coarse, fewer, std::nullopt, max_iterations).status;
  BoundStatuses start;
  for (int i = 0; i < count; ++i)
    start.push_back(common_status(status[std::min(i / 2, fewer.count() - 1)],
                                  status[std::clamp((i - 1) / 2, 0, fewer.count() - 1)]));
  return bounds.nearest_valid(std::move(start));
}

}  // namespace antilock
