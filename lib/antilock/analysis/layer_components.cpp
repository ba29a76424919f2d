#include "antilock/analysis/layer_components.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace antilock {

LayerComponents layer_components(const TriangleMesh& mesh) {
  const auto x = [&](int v) { return mesh.vertices(v, 0); };
  std::vector<int> leader(mesh.triangle_count());
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](int t) {
    while (leader[t] != t) t = leader[t] = leader[leader[t]];
    return t;
  };
  // A generator places the points of a vertical line to about 1e-12.
  // Vertices that are moved on purpose are moved farther.
  const double vertical = 1e-9 * body_size(mesh);
  int edges = 0;
  double length = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = mesh.edge_triangles(e, 0), b = mesh.edge_triangles(e, 1);
    if (mesh.edge_tag[e] == EdgeTag::sigma) {
      ++edges;
      length += mesh.edge_length(e);
    }
    if (b >= 0 && mesh.region[a] == Region::layer && mesh.region[b] == Region::layer &&
        std::abs(x(mesh.edges(e, 0)) - x(mesh.edges(e, 1))) > vertical)
      leader[find(a)] = find(b);
  }
  LayerComponents components;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::layer && leader[t] == t) ++components.count;
  if (components.count != edges) return components;
  Eigen::ArrayXd from = Eigen::ArrayXd::Constant(mesh.triangle_count(),
                                                 std::numeric_limits<double>::infinity()),
                 to = -from;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3 && mesh.region[t] == Region::layer; ++i) {
      from(find(t)) = std::min(from(find(t)), x(mesh.triangles(t, i)));
      to(find(t)) = std::max(to(find(t)), x(mesh.triangles(t, i)));
    }
  components.is_aligned = (to - from).max(0).sum() <= length * (1 + 1e-9);
  return components;
}

}  // namespace antilock
