#pragma once
// What chapter 02 measures and draws of its meshes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// The smallest angle of all triangles, in degrees.
inline double smallest_angle(const TriangleMesh& mesh) {
  double smallest = std::numbers::pi;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const Eigen::RowVector2d at = mesh.vertices.row(mesh.triangles(t, i));
      const Eigen::RowVector2d a = mesh.vertices.row(mesh.triangles(t, (i + 1) % 3)) - at;
      const Eigen::RowVector2d b = mesh.vertices.row(mesh.triangles(t, (i + 2) % 3)) - at;
      smallest = std::min(smallest, std::acos(a.dot(b) / (a.norm() * b.norm())));
    }
  return smallest * 180 / std::numbers::pi;
}

/// A mesh, and the leader of the group of each of its triangles (-1 in the body).
struct TiedMesh {
  std::string name;
  TriangleMesh mesh;
  std::vector<int> leader;
  int groups;
};

/// The layers side by side, two per row, their triangles coloured by group from left to
/// right, as a table of shapes that figures/pictures/domain.cpp reads.
inline void draw_ties(const std::filesystem::path& path,
                      const std::vector<TiedMesh>& layers) {
  Table table({"kind", "name", "label", "x", "y"});
  table.add({"page", "", "", -0.04, -2.5});
  table.add({"page", "", "", 2.16, 0.06});
  for (std::size_t m = 0; m < layers.size(); ++m) {
    const TriangleMesh& mesh = layers[m].mesh;
    const std::vector<int>& leader = layers[m].leader;
    const double left = 1.12 * static_cast<double>(m % 2), top = m < 2 ? -0.1 : -1.36;
    std::map<int, double> from;  // the smallest x of each group
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (int i = 0; leader[t] >= 0 && i < 3; ++i) {
        const double x = mesh.vertices(mesh.triangles(t, i), 0);
        from[leader[t]] = from.contains(leader[t]) ? std::min(from[leader[t]], x) : x;
      }
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      if (leader[t] < 0) continue;
      const auto place = std::count_if(from.begin(), from.end(), [&](const auto& group) {
        return group.second < from[leader[t]] - 1e-9;
      });
      const auto corner = [&](const char* kind, const std::string& named, int i) {
        const int v = mesh.triangles(t, i % 3);
        table.add({kind, named, "", left + mesh.vertices(v, 0), top + mesh.vertices(v, 1)});
      };
      for (int i = 0; i < 3; ++i)
        corner("fill", fmt::format("tied{} {}.{}", place % 6, m, t), i);
      for (int i = 0; i < 4; ++i) corner("line", fmt::format("axis {}.{}", m, t), i);
    }
    table.add({"label", "axis",
               fmt::format("{}: {} {}", layers[m].name, layers[m].groups,
                           layers[m].groups == 1 ? "group" : "groups"),
               left + 0.5, top + 0.07});
  }
  table.write(path);
}

}  // namespace antilock::tutorial
