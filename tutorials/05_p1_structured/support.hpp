#pragma once
// What chapter 05 reads off its solution, and what its pictures are drawn from.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/measure/contact_zone.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/table.hpp"
#include "course/course.hpp"

namespace antilock::tutorial {

/// u and the contact pressure on Gamma_C, each over its largest value, one row per contact
/// unknown: x, u0, u1, ..., pressure0, pressure1, ... in the order of the epsilons.
inline Table on_contact(const std::vector<double>& epsilons, const Space& space) {
  std::vector<std::string> columns{"x"};
  for (const char* kind : {"u", "pressure"})
    for (std::size_t k = 0; k < epsilons.size(); ++k)
      columns.push_back(fmt::format("{}{}", kind, k));
  std::vector<Eigen::MatrixX3d> found;
  for (const double epsilon : epsilons) {
    const VariationalInequality problem = assemble(paper_scene(epsilon), space);
    found.push_back(contact_table({space, problem, active_set(problem)}));
    for (const int column : {1, 2})
      found.back().col(column) /= found.back().col(column).maxCoeff();
  }
  Table table(columns);
  for (Eigen::Index i = 0; i < found[0].rows(); ++i) {
    std::vector<TableEntry> row{found[0](i, 0)};
    for (const int column : {1, 2})
      for (const auto& one : found) row.emplace_back(one(i, column));
    table.add(row);
  }
  return table;
}

/// Sawteeth with n = 4, 8, 16 teeth and the slopes +-1 as shapes that
/// figures/pictures/domain.cpp reads.
inline Table sawteeth() {
  Table table({"kind", "name", "label", "x", "y"});
  for (const auto& [x, y] : {std::pair{-0.03, -0.6}, {1.03, 0.16}})
    table.add({"page", "", "", x, y});
  for (int row = 0; row < 3; ++row) {
    const int n = 4 << row;
    const double foot = -0.24 * row;
    for (const double x : {0.0, 1.0})
      table.add({"line", fmt::format("axis {}", n), "", x, foot});
    for (int k = 0; k <= 2 * n; ++k)
      table.add({"line", fmt::format("sigma {}", n), "", 0.5 * k / n,
                 foot + (k % 2 == 0 ? 0 : 0.5 / n)});
    table.add({"label", "axis", fmt::format("largest value 1/{}, slopes 1 and −1", 2 * n),
               0.5, foot - 0.045});
  }
  return table;
}

/// The layer stress of P1 on a structured mesh (Figure 3) in the top, the middle and the
/// bottom row of cells, one row per inner vertical line: x, top, middle, bottom.
inline Table stress_by_depth(const Space& space, const Solution& solution) {
  const TriangleMesh& mesh = space.mesh();
  const int n = static_cast<int>(
      std::lround(std::sqrt(solution.p.size() / 2.0)));  // n x n cells, two triangles each
  Eigen::MatrixXd p = Eigen::MatrixXd::Zero(n, n);
  for (int t = 0, row = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] == Region::body) continue;
    const double px = solution.p(row++);
    double x = 0, y = 0, left = 1;
    for (int i = 0; i < 3; ++i) {
      x += mesh.vertices(mesh.triangles(t, i), 0) / 3,
          y += mesh.vertices(mesh.triangles(t, i), 1) / 3;
      left = std::min(left, mesh.vertices(mesh.triangles(t, i), 0));
    }
    if (x - left > 0.5 / n)
      p(static_cast<int>((y + 1) * n), static_cast<int>(x * n)) =
          px;  // its vertical edge: right
  }
  Table table({"x", "top", "middle", "bottom"});
  for (int i = 0; i + 1 < n; ++i)
    table.add(
        {(i + 1.0) / n, p(n - 1, i), 0.5 * (p(n / 2, i) + p((n - 1) / 2, i)), p(0, i)});
  return table;
}

}  // namespace antilock::tutorial
