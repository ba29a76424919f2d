#pragma once
// Meshes of two bodies, (0,1) x (0,1) and below it (0,1) x (-1,0), which do not match between them.
#include <algorithm>
#include <random>
#include <vector>

#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/two_bodies.hpp"
#include "antilock/models/plane_strain.hpp"

namespace antilock::test {

/// The unit square in cells whose columns have random widths; the sides are clamped or free.
inline TriangleMesh random_columns(int cells, std::mt19937& random, bool free_sides) {
  TriangleMesh mesh = structured_mesh(cells, {0}, Diagonal::crossed);
  std::uniform_real_distribution<double> width(0.2, 1);
  std::vector<double> ends{0};
  for (int i = 0; i < cells; ++i) ends.push_back(ends.back() + width(random));
  const auto moved = [&](double x) {
    const double at = x * cells;
    const int i = std::min(static_cast<int>(at), cells - 1);
    return (ends[i] + (at - i) * (ends[i + 1] - ends[i])) / ends.back();
  };
  for (double& x : mesh.vertices.col(0).reshaped()) x = moved(x);
  return free_sides ? with_free_sides(std::move(mesh)) : mesh;
}

/// Two such squares.
inline TriangleMesh random_bodies(int upper, int lower, std::mt19937& random, bool free_sides) {
  const TriangleMesh above = random_columns(upper, random, free_sides);
  return two_body_mesh(above, random_columns(lower, random, free_sides));
}

/// Whether a triangle is in the upper one.
inline bool is_above(const TriangleMesh& mesh, int t) {
  double sum = 0;
  for (const int v : mesh.triangles.row(t)) sum += mesh.vertices(v, 1);
  return sum > 0;
}

/// N values: 1 for the unknowns of the upper body, 0 for those of the lower one.
inline Eigen::VectorXd in_upper_body(const Space& space) {
  Eigen::VectorXd in_upper = Eigen::VectorXd::Zero(space.size());
  for (int t = 0; t < space.mesh().triangle_count(); ++t)
    if (is_above(space.mesh(), t))
      for (const int unknown : space.cell_dofs().row(t)) in_upper(unknown) = 1;
  return in_upper;
}

}  // namespace antilock::test
