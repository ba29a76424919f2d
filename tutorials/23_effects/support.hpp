#pragma once
#include "antilock/core/stopwatch.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

/// A scene from question to answer by Crouzeix-Raviart and the active set, and what each
/// step took (seconds).
struct Run {
  Run(const Scene& scene, TriangleMesh mesh) : space(std::move(mesh), crouzeix_raviart()) {
    Stopwatch watch;
    problem = assemble(scene, space);
    assemble_seconds = watch.lap();
    solution = active_set(problem);
    solve_seconds = watch.lap();
    contact_from = contact_zone({space, problem, solution}).from.value_or(1);
    energy = antilock::energy(problem, solution);
  }
  Space space;
  VariationalInequality problem;
  Solution solution;
  double energy = 0, contact_from = 1, assemble_seconds = 0, solve_seconds = 0;

  /// The largest |u - truth| at the contact unknowns.
  double error_on_contact(const ExactSolution& exact) const {
    double error = 0;  // gap = u where the obstacle is flat
    const Eigen::MatrixX3d points = contact_table({space, problem, solution});
    for (const auto& point : points.rowwise())
      error = std::max(error, std::abs(point(1) - exact.value(point(0), -1)));
    return error;
  }
};

/// What a scene costs: its name, triangles, unknowns, factorisations, solves, contact,
/// corrections, assemble_s, solve_s, and the smallest and the largest u.
inline const std::vector<std::string> cost_columns{
    "scene",       "triangles",  "unknowns", "factorisations", "solves", "contact",
    "corrections", "assemble_s", "solve_s",  "u_min",          "u_max"};
inline std::vector<TableEntry> costs(const std::string& name, const Run& run) {
  const Counters& c = run.solution.counters;
  return {name,
          run.space.mesh().triangle_count(),
          c.unknowns,
          c.factorisations,
          c.solves,
          c.contact_iterations,
          c.corrections,
          run.assemble_seconds,
          run.solve_seconds,
          run.solution.u.minCoeff(),
          run.solution.u.maxCoeff()};
}

/// The structured mesh with its layer pressed to the thickness epsilon.
inline TriangleMesh pressed_mesh(int cells, double epsilon) {
  TriangleMesh mesh = structured_mesh(cells);
  for (auto vertex : mesh.vertices.rowwise())
    if (vertex(1) < 0) vertex(1) *= epsilon;
  return mesh;
}

}  // namespace antilock::tutorial
