#include "antilock/analysis/detail/ties.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

namespace antilock {
namespace {

bool is_vertical(const TriangleMesh& mesh, int edge) {
  const double dx = mesh.vertices(mesh.edges(edge, 0), 0) - mesh.vertices(mesh.edges(edge, 1), 0);
  return std::abs(dx) <= 1e-12;  // of coordinates that are rounded once
}

/// Per triangle one of its group, for the layer's triangles.
std::vector<int> leaders(const TriangleMesh& mesh) {
  std::vector<int> leader(mesh.triangle_count());
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](int t) {
    while (leader[t] != t) t = leader[t] = leader[leader[t]];
    return t;
  };
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = mesh.edge_triangles(e, 0), b = mesh.edge_triangles(e, 1);
    if (b < 0 || mesh.region[a] == Region::body || mesh.region[b] == Region::body || is_vertical(mesh, e)) continue;
    leader[find(a)] = find(b);
  }
  for (int t = 0; t < mesh.triangle_count(); ++t) leader[t] = find(t);
  return leader;
}

}  // namespace

int tied_groups(const TriangleMesh& mesh) {
  const std::vector<int> leader = leaders(mesh);
  int groups = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) groups += mesh.region[t] == Region::layer && leader[t] == t ? 1 : 0;
  return groups;
}

bool in_columns(const TriangleMesh& mesh) {
  if (tied_groups(mesh) != std::count(mesh.edge_tag.begin(), mesh.edge_tag.end(), EdgeTag::sigma)) return false;
  const std::vector<int> leader = leaders(mesh);
  std::map<int, std::array<double, 2>> from_to;  // of each group, in x
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3 && mesh.region[t] == Region::layer; ++i) {
      const double x = mesh.vertices(mesh.triangles(t, i), 0);
      auto& [from, to] = from_to.try_emplace(leader[t], std::array{x, x}).first->second;
      from = std::min(from, x), to = std::max(to, x);
    }
  double widths = 0, length = 0;
  for (const auto& [group, ends] : from_to) widths += ends[1] - ends[0];
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == EdgeTag::sigma) length += mesh.edge_length(e);
  return widths <= length * (1 + 1e-9);  // side by side, without overlap
}

}  // namespace antilock
