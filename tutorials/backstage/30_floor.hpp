#pragma once
#include <cmath>
#include <map>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/study/table.hpp"
#include "backstage/26_rubber.hpp"
#include "common/course.hpp"

namespace antilock::tutorial {

/// The floor at one λ: N in all; T on the left half, to the right, as the mean of both halves by symmetry; the slip
/// u_x of the left half that is largest in size; the length that sticks though g > 0. The reference is Taylor–Hood on
/// graded meshes (`freefem/30_friction.edp`).
inline const std::vector<std::string> floor_columns{"element", "h",      "lambda",      "epsilon", "locks", "N",    "T",
                                                    "slip",    "sticks", "corrections", "known",   "N off", "T off"};
inline std::vector<Entry> floor_row(const Rubber& rubber, int cells, const Space& x,
                                    const VariationalInequality& problem, const Solution& solution) {
  static const std::map<double, std::pair<double, double>> reference{
      {1, {0.16034, -0.01627}}, {1e-4, {0.26073, 0.01222}}, {1e-8, {0.26077, 0.01223}}, {0, {0.26077, 0.01223}}};
  double normal = 0, tangential = 0, sticks = 0, slip = 0;
  for (Eigen::Index i = 0; i < solution.lambda.size(); ++i) {
    if (!std::isfinite(problem.force_bound(i))) {
      normal += solution.lambda(i);
      continue;
    }
    const double place = x.points()(problem.contact[i], 0), moved = solution.u(problem.contact[i]);
    tangential += place == 0.5 ? 0 : (place < 0.5 ? 0.5 : -0.5) * solution.lambda(i);
    if (problem.force_bound(i) == 0) continue;
    if (solution.active[i]) sticks += 1.0 / cells;
    if (place < 0.5 && std::abs(moved) > std::abs(slip)) slip = moved;
  }
  const double epsilon = problem.compliance;
  const auto at = reference.find(epsilon);
  const auto off = [&](double value, double exact) { return 100 * std::abs(value / exact - 1); };
  const bool known = at != reference.end();
  return {rubber.name,
          1.0 / cells,
          1 / epsilon,
          epsilon,
          rubber.locks,
          normal,
          tangential,
          slip,
          sticks,
          solution.counters.corrections,
          known,
          known ? off(normal, at->second.first) : 0.0,
          known ? off(tangential, at->second.second) : 0.0};
}

/// At most by how many h^2 of itself T is off, and by how many h per cent N.
inline std::pair<double, double> off_by(const Table& floor) {
  double of_t = 0, of_n = 0;
  for (const Table& row : floor.rows()) {
    of_t = std::max(of_t, row.number("T off") * std::pow(row.number("h"), -2) / 100);
    of_n = std::max(of_n, row.number("N off") / row.number("h"));
  }
  return {of_t, of_n};
}

}  // namespace antilock::tutorial
