#pragma once
#include "antilock/adapt/solve_to.hpp"
#include "antilock/analysis/exact_errors.hpp"
#include "backstage/19_certified.hpp"
#include "common/course.hpp"

namespace antilock::tutorial {

/// The layer in contact under a load chosen here: "paper", f = 10 sin(2 pi x), or "bump", 400 exp(-r^2 / (2 0.02^2))
/// around (0.3, 0.6).
inline Scene load_scene(const std::string& load, double epsilon) {
  const Field bump = [](double x, double y) {
    return 400 * std::exp(-(std::pow(x - 0.3, 2) + std::pow(y - 0.6, 2)) / (2 * 0.02 * 0.02));
  };
  return Scene(Body{load == "bump" ? bump : Field(paper_load)}, StiffLayer{epsilon}, UnilateralContact{});
}

/// load, epsilon, method; asked and of what; unknowns, those quoted one level before (0: none), seconds of all levels;
/// quantity ("bound": proved, "error": against the exact solution) and its value, relative to |u|_a; levels; of_asked,
/// of_quoted: value / asked, unknowns / quoted; of_bound: value / bound.
inline const std::vector<std::string> accuracy_columns{"load",     "epsilon",  "method",    "asked",    "of",
                                                       "unknowns", "quoted",   "seconds",   "quantity", "value",
                                                       "levels",   "of_asked", "of_quoted", "of_bound"};

struct Answer {
  std::string load, method;
  double epsilon, asked = 0;
  Quantity of = Quantity::displacement;
  int unknowns = 0, levels = 1;
  double quoted = 0, seconds = 0, bound = 0;
};

inline std::vector<Entry> row(const Answer& a, const std::string& quantity, double value) {
  return {a.load,
          a.epsilon,
          a.method,
          a.asked,
          a.of == Quantity::stress ? "stress" : "displacement",
          a.unknowns,
          a.quoted,
          a.seconds,
          quantity,
          value,
          a.levels,
          a.asked > 0 ? value / a.asked : 1,
          a.quoted > 0 ? a.unknowns / a.quoted : 1,
          value / a.bound};
}

/// Of |u|_a: on a cone K, |u|_a^2 = -2 J(u).
inline double relative_error(const Exact& exact, const Scene& scene, const Space& space, const Solution& cr,
                             const Companion& v, Quantity of) {
  const double norm = std::sqrt(-2 * exact.truth.energy());
  if (of == Quantity::displacement)
    return exact.errors(space, cr).energy / norm;  // of Crouzeix-Raviart: the same bound
  const VariationalInequality problem = assemble(scene, space);
  return exact_errors(space.mesh(), equilibrated_flux(scene, space, problem, cr), v, exact.table).stress / norm;
}

/// The bound of an answer, and for the paper's load its error.
inline Table accuracy_rows(const std::string& load, const Exact& exact, const std::string& method, double asked,
                           Quantity of, const CertifiedSolution& found) {
  const Level& last = found.history.back();
  Answer answer{load, method, exact.epsilon, asked, of, last.unknowns, static_cast<int>(found.history.size())};
  if (found.history.size() > 3) answer.quoted = found.history[found.history.size() - 2].quoted_unknowns;
  answer.seconds = last.seconds;
  answer.bound = last.relative;
  Table rows(accuracy_columns);
  rows.add(row(answer, "bound", answer.bound));
  if (load != "paper") return rows;
  const Companion v{.at_vertices = found.companion.u, .stress = found.companion.p, .layer = std::nullopt};
  rows.add(
      row(answer, "error",
          relative_error(exact, load_scene(load, exact.epsilon), found.answer.space, found.answer.solution, v, of)));
  return rows;
}

}  // namespace antilock::tutorial
