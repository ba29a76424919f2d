#include "common/ties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "antilock/study/table.hpp"

namespace antilock::tutorial {

Ties ties(const TriangleMesh& mesh) {
  std::vector<int> leader(mesh.triangle_count());
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](int t) {
    while (leader[t] != t) t = leader[t] = leader[leader[t]];
    return t;
  };
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = mesh.edge_triangles(e, 0), b = mesh.edge_triangles(e, 1);
    if (b < 0 || mesh.region[a] == Region::body || mesh.region[b] == Region::body) continue;
    const double dx = mesh.vertices(mesh.edges(e, 0), 0) - mesh.vertices(mesh.edges(e, 1), 0);
    if (std::abs(dx) > 1e-12) leader[find(a)] = find(b);  // 1e-12: of coordinates that are rounded once
  }
  std::vector<double> left(mesh.triangle_count(), 2);  // smallest x of each group: they are numbered from left to right
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) left[find(t)] = std::min(left[find(t)], mesh.vertices(mesh.triangles(t, i), 0));
  std::vector<int> leaders, number(mesh.triangle_count(), -1);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::layer && find(t) == t) leaders.push_back(t);
  std::sort(leaders.begin(), leaders.end(), [&](int a, int b) { return left[a] < left[b]; });
  for (std::size_t i = 0; i < leaders.size(); ++i) number[leaders[i]] = static_cast<int>(i);
  Ties found{std::vector<int>(mesh.triangle_count(), -1), static_cast<int>(leaders.size())};
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::layer) found.group[t] = number[find(t)];
  return found;
}

void draw_ties(const std::filesystem::path& path, const std::vector<std::pair<std::string, TriangleMesh>>& meshes) {
  Table table({"kind", "name", "label", "x", "y"});
  const double step = 1.12, right = step * (0.5 * static_cast<double>(meshes.size())) - 0.12;
  table.add({"page", "", "", -0.04, -2.5});
  table.add({"page", "", "", right + 0.04, 0.06});
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const TriangleMesh& mesh = meshes[m].second;
    const double left = step * static_cast<double>(m % 2), top = m < 2 ? -0.1 : -1.36;
    const Ties found = ties(mesh);
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      if (found.group[t] < 0) continue;
      const auto corner = [&](const char* kind, const std::string& named, int i) {
        const int v = mesh.triangles(t, i % 3);
        table.add({kind, named, "", left + mesh.vertices(v, 0), top + mesh.vertices(v, 1)});
      };
      for (int i = 0; i < 3; ++i) corner("fill", fmt::format("tied{} {}.{}", found.group[t] % 6, m, t), i);
      for (int i = 0; i < 4; ++i) corner("line", fmt::format("axis {}.{}", m, t), i);
    }
    table.add({"label", "axis",
               fmt::format("{}: {} {}", meshes[m].first, found.groups, found.groups == 1 ? "group" : "groups"),
               left + 0.5, top + 0.07});
  }
  table.write(path);
}

double smallest_angle(const TriangleMesh& mesh) {
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

}  // namespace antilock::tutorial
