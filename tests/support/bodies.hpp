#pragma once
#include <functional>
#include <vector>

#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/submesh.hpp"

namespace antilock::test {

/// Those triangles of the structured unit square whose centroid is inside; what becomes boundary on
/// y = 0 is contact, the rest clamped.
inline TriangleMesh submesh(int cells, const std::function<bool(double x, double y)>& inside) {
  const TriangleMesh square = structured_mesh(cells, {0});
  return antilock::submesh(square,
                           [&](int t) {
                             const auto centroid =
                                 square.vertices(square.triangles.row(t), Eigen::indexing::all)
                                     .colwise()
                                     .mean()
                                     .eval();
                             return inside(centroid(0), centroid(1));
                           })
      .mesh;
}

/// An L over the whole of Sigma, re-entrant corner at (1/2, 1/2).
inline TriangleMesh l_shape(int cells) {
  return submesh(cells, [](double x, double y) { return x < 0.5 || y < 0.5; });
}
/// A bridge: Sigma in two pieces, each of length 1/4, under the feet of a body 1 x 1 less 1/2 x
/// 1/2.
inline TriangleMesh bridge(int cells) {
  return submesh(cells, [](double x, double y) { return y > 0.5 || x < 0.25 || x > 0.75; });
}

/// With other tags on its clamped edges, by the middles of those.
inline TriangleMesh retagged(TriangleMesh mesh,
                             const std::function<EdgeTag(double x, double y)>& tag) {
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == EdgeTag::clamped) {
      const auto x = mesh.vertices(mesh.edges.row(e), Eigen::indexing::all).colwise().mean().eval();
      mesh.edge_tag[e] = tag(x(0), x(1));
    }
  return mesh;
}

}  // namespace antilock::test
