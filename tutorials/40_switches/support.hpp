#pragma once
// The meshes, patch test and files of 40_switches.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "antilock/analysis/kernel.hpp"
#include "antilock/form/edge_forms.hpp"
#include "antilock/form/h1_gram_matrix.hpp"
#include "antilock/form/strain_projection.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/models/project_strain.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

/// The cells of the layer, and the edges on its sides.
struct LayerCounts {
  int cells = 0, vertices = 0, sigma = 0, bottom = 0, sides = 0;
};
inline LayerCounts layer_counts(const Mesh& mesh) {
  LayerCounts counts;
  std::set<int> vertices;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::layer) continue;
    ++counts.cells;
    vertices.insert(mesh.triangles.row(t).begin(), mesh.triangles.row(t).end());
  }
  counts.vertices = static_cast<int>(vertices.size());
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const bool of_layer = mesh.region[mesh.edge_triangles(e, 0)] == Region::layer;
    if (mesh.edge_tag[e] == EdgeTag::sigma) ++counts.sigma;
    if (mesh.edge_tag[e] == EdgeTag::contact) ++counts.bottom;
    if (is_dirichlet(mesh.edge_tag[e]) && of_layer) ++counts.sides;
  }
  return counts;
}

/// The patch test: the solution of a1 + a0 without load whose prescribed values, on the
/// whole boundary, are those of w = x - 2 y. Returns the largest difference from w at an
/// unknown.
inline double patch_test(const Space& space, VariationalInequality problem) {
  const Field w = [](double x, double y) { return x - 2 * y; };
  const Eigen::VectorXd exact = dof_values(space, w);
  std::set<int> given(space.dirichlet_dofs().begin(), space.dirichlet_dofs().end());
  given.insert(space.contact_dofs().begin(), space.contact_dofs().end());
  problem.dirichlet_dofs.assign(given.begin(), given.end());
  problem.dirichlet_values = exact(problem.dirichlet_dofs);
  problem.bounds = {};
  problem.load.setZero();
  problem.compliance = 1;
  return (active_set(problem).u - exact).cwiseAbs().maxCoeff();
}

/// Writes a mesh of quadrilaterals for a program that is not of the library.
inline void write_mesh(const std::filesystem::path& out, const Mesh& mesh) {
  Table vertices({"x", "y"}), cells({"a", "b", "c", "d", "region"});
  for (int v = 0; v < mesh.vertex_count(); ++v)
    vertices.add({mesh.vertices(v, 0), mesh.vertices(v, 1)});
  for (int t = 0; t < mesh.triangle_count(); ++t)
    cells.add({mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2),
               mesh.triangles(t, 3), static_cast<int>(mesh.region[t])});
  vertices.write(out / "vertices.csv");
  cells.write(out / "cells.csv");
}

}  // namespace antilock::tutorial
