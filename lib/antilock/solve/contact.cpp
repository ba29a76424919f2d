#include "antilock/solve/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

/// A bound that is off its piece: a force by more than round-off, a value by anything. (A value off by round-off costs
/// a step of the descent, which stays finite. Forces that are 0 but for round-off would be let go of in ever other
/// sets.)
struct Breakpoint {
  int bound;
  BoundStatus next_status;  ///< the piece beyond that end
  double value;             ///< of the piece, where its value has left it
  double step{};            ///< the part of the way at which its value comes there
};

Equilibrium equilibrium(ContactSystem& system, const Bounds& bounds, const BoundStatuses& status) {
  std::vector<char> active(status.size());
  Eigen::VectorXd prescribed(bounds.count());
  for (int i = 0; i < bounds.count(); ++i) {
    active[i] = is_active(status[i]) ? 1 : 0;
    prescribed(i) = bounds.prescribed(i, status[i]);
  }
  return system.solve(active, prescribed);
}

/// The bounds whose forces have left their pieces, or (`active` = false) those whose values have.
std::vector<Breakpoint> violations(const Bounds& bounds, const BoundStatuses& status, const Equilibrium& now,
                                   const std::vector<int>& dof_of, bool active) {
  std::vector<Breakpoint> violations;
  for (int i = 0; i < bounds.count(); ++i) {
    if (is_active(status[i]) != active) continue;
    const double value = active ? now.lambda(i) : now.v(dof_of[i]);
    const auto [low, high] = bounds.admissible_range(i, status[i]);
    const double noise = active ? now.round_off(i) : 0;
    const bool under = value<low - noise, over = value> high + noise;
    if (under || over)  // too little force: v must rise
      violations.push_back({i, bounds.next(i, status[i], active == under), under ? low : high});
  }
  return violations;
}

/// v goes towards w, as far as contact.hpp says; `breakpoints` leave their pieces there.
void projected_search(const ContactSystem& system, std::vector<Breakpoint>& breakpoints, const Eigen::VectorXd& w,
                      Eigen::VectorXd& v, BoundStatuses& status) {
  const Eigen::VectorXd direction = w - v;
  const std::vector<int>& dof_of = system.bounded();
  for (Breakpoint& m : breakpoints) {
    const double all = direction(dof_of[m.bound]), share = (m.value - v(dof_of[m.bound])) / all;
    m.step = all != 0 && share > 0 ? std::min(share, 1.0) : 0;  // 0 where it is no number, so that the loop ends
  }
  std::sort(breakpoints.begin(), breakpoints.end(),
            [](const Breakpoint& a, const Breakpoint& b) { return a.step < b.step; });
  const double first = breakpoints.front().step, visited_faces = (1 - first) * (1 - first) * system.square(direction);
  Eigen::VectorXd next;
  double part = 1;
  for (std::size_t stopped = breakpoints.size();; part = breakpoints[stopped - 1].step) {
    next = v + part * direction;
    for (const Breakpoint& m : breakpoints)
      if (m.step <= part) next(dof_of[m.bound]) = m.value;
    if (part == first || system.square(w - next) < visited_faces) break;
    stopped = std::max<std::size_t>(stopped / 2, 1);
  }
  for (const Breakpoint& m : breakpoints)
    if (m.step <= part) status[m.bound] = m.next_status;
  v = std::move(next);
}

}  // namespace

ContactResult solve_contact(ContactSystem& system, const Bounds& bounds, const std::optional<BoundStatuses>& start,
                            int max_steps) {
  BoundStatuses status = bounds.nearest_valid(start ? *start : system.nested_start(bounds, max_steps));
  std::set<BoundStatuses> visited_faces;  // of all pieces whose lowest point is on them
  Eigen::VectorXd v;
  for (int steps = 1;; ++steps) {
    Equilibrium now = equilibrium(system, bounds, status);
    std::vector<Breakpoint> violated = violations(bounds, status, now, system.bounded(), false);
    const bool feasible = violated.empty();
    if (feasible) violated = violations(bounds, status, now, system.bounded(), true);
    if (violated.empty() || (feasible && !visited_faces.insert(status).second)) {
      for (int i = 0; i < bounds.count(); ++i) now.lambda(i) = bounds.total_force(i, status[i], now.lambda(i));
      return {std::move(now.v), std::move(now.lambda), std::move(status), steps};
    }
    if (steps >= max_steps)
      throw NotConverged(fmt::format("contact: {} of {} contact conditions still violated after {} steps",
                                     violated.size(), bounds.count(), steps),
                         static_cast<double>(violated.size()) / bounds.count(), steps);
    if (feasible) {
      for (const Breakpoint& m : violated) status[m.bound] = m.next_status;
      v = std::move(now.v);
      continue;
    }
    if (v.size() == 0) v = now.v;  // the descent starts with no way to go: all that are beyond go to their ends
    projected_search(system, violated, now.v, v, status);
  }
}

BoundStatuses coarse_start(const Bounds& bounds, ContactSystem& coarse, int max_steps) {
  const int count = bounds.count();
  const auto second = [](const Eigen::VectorXd& of_all) {
    return Eigen::VectorXd(of_all(Eigen::seqN(1, of_all.size() / 2, 2)));
  };
  Bounds fewer{second(bounds.lower), second(bounds.upper), second(bounds.force_limit),
               second(bounds.accumulated_force)};
  // where the others bear nothing, one bears its own force and half of what each neighbour gives up
  for (int i = 0; i < count && bounds.force_limit.size() > 0; i += 2)
    for (const int beside : {i / 2 - 1, i / 2})
      if (beside >= 0 && beside < fewer.count() && std::isfinite(bounds.force_limit(i)))
        fewer.force_limit(beside) += 0.5 * bounds.force_limit(i);
  const BoundStatuses status = solve_contact(coarse, fewer, std::nullopt, max_steps).status;
  BoundStatuses start;
  for (int i = 0; i < count; ++i)
    start.push_back(common_status(status[std::min(i / 2, fewer.count() - 1)],
                                  status[std::clamp((i - 1) / 2, 0, fewer.count() - 1)]));
  return bounds.nearest_valid(std::move(start));
}

}  // namespace antilock
