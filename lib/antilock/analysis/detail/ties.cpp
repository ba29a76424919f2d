#include "antilock/analysis/detail/ties.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace antilock {
namespace {

bool is_vertical(const TriangleMesh& mesh, int edge) {
  const double dx = mesh.vertices(mesh.edges(edge, 0), 0) - mesh.vertices(mesh.edges(edge, 1), 0);
  return std::abs(dx) <= 1e-12;  // of coordinates that are rounded once
}

}  // namespace

int tied_groups(const TriangleMesh& mesh) {
  std::vector<int> leader(mesh.triangle_count());
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](int t) {
    while (leader[t] != t) t = leader[t] = leader[leader[t]];
    return t;
  };
  auto groups = static_cast<int>(std::count(mesh.region.begin(), mesh.region.end(), Region::layer));
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = mesh.edge_triangles(e, 0), b = mesh.edge_triangles(e, 1);
    if (b < 0 || mesh.region[a] == Region::body || mesh.region[b] == Region::body || is_vertical(mesh, e)) continue;
    const int one = find(a), other = find(b);
    if (one != other) leader[one] = other, --groups;
  }
  return groups;
}

bool in_columns(const TriangleMesh& mesh) {
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const auto edges = mesh.triangle_edges.row(t);
    if (mesh.region[t] == Region::layer &&
        std::none_of(edges.begin(), edges.end(), [&](int e) { return is_vertical(mesh, e); }))
      return false;
  }
  return true;
}

}  // namespace antilock
