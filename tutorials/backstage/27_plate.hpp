#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/core/stopwatch.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/models/plate.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/table.hpp"
#include "backstage/27_truth.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

/// FILE.vtu, mesh.freefem.msh, and rows x, element, w along the diameter y = 0; with "p1" the exact plate's too.
inline void draw(const Options& options, const PlateElement& method, const Space& w, const Solution& solution,
                 Table& profile) {
  const TriangleMesh& mesh = w.mesh();
  const PlateTruth truth(std::sqrt(options.epsilon));
  std::vector<std::pair<double, int>> edges;  // x of the midpoint, edge
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = mesh.edges(e, 0), b = mesh.edges(e, 1);
    if (std::abs(mesh.vertices(a, 1)) + std::abs(mesh.vertices(b, 1)) < 1e-9)
      edges.emplace_back((mesh.vertices(a, 0) + mesh.vertices(b, 0)) / 2, e);
  }
  std::sort(edges.begin(), edges.end());
  for (const auto& [x, e] : edges) {
    const double mean = (solution.u(mesh.edges(e, 0)) + solution.u(mesh.edges(e, 1))) / 2;
    profile.add({x, method.file, method.deflection.conforming() ? mean : solution.u(e)});
    if (method.file == "p1") profile.add({x, "exact", truth.deflection(std::abs(x))});
  }
  write_freefem_mesh(options.out / "mesh.freefem.msh", mesh);
  write_vtu(options.out / (method.file + ".vtu"), w, solution.u.head(w.size()));
}

/// Prints the checks, one row per element; writes errors.csv (three meshes) and profile.csv.
inline void print_plate(const Options& options, const Table& checks, const Table& errors, const Table& profile) {
  checks.print("", 3);
  errors.where_number("t", [](double t) { return t >= 1e-6; })
      .where_number("rings", [&](double n) { return n <= options.cells; })
      .write(options.out / "errors.csv");
  profile.pivot("x", "element", "w").write(options.out / "profile.csv");
}

}  // namespace antilock::tutorial
