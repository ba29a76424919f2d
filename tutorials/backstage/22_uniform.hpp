#pragma once
#include <map>

#include "antilock/core/stopwatch.hpp"
#include "backstage/22_accuracies.hpp"

namespace antilock::tutorial {

/// The certificate on gmsh's uniform meshes from 1/8 to 1/finest; the seconds add up, without gmsh's own.
inline Table on_uniform_meshes(const std::string& load, const Exact& exact, int finest) {
  static std::map<int, TriangleMesh> meshes;  // gmsh's time is not counted, nor spent twice
  const Scene scene = load_scene(load, exact.epsilon);
  Table rows(accuracy_columns);
  Answer answer{load, "uniform", exact.epsilon};
  for (int cells = 8; cells <= finest; cells *= 2) {
    if (!meshes.contains(cells)) meshes.emplace(cells, unstructured_mesh(cells));
    const TriangleMesh& mesh = meshes.at(cells);
    Stopwatch watch;
    const Space space(mesh, crouzeix_raviart());
    const VariationalInequality problem = assemble(scene, space);
    PenaltyFactor factor(problem);
    const Solution solution = active_set(problem, factor);
    answer.bound = certify(scene, space, problem, solution, {.factor = &factor}).relative(Quantity::displacement);
    answer.seconds += watch.lap();
    answer.unknowns = space.free_count();
    rows.add(row(answer, "bound", answer.bound));
    if (load == "paper")
      rows.add(row(answer, "error", relative_error(exact, scene, space, solution, {}, Quantity::displacement)));
  }
  return rows;
}

}  // namespace antilock::tutorial
