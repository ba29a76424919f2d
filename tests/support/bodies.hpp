#pragma once
#include <functional>
#include <vector>

#include "antilock/mesh/generate.hpp"

namespace antilock::test {

/// Those triangles of the structured unit square whose centroid is inside; what becomes boundary on y = 0 is contact,
/// the rest clamped.
inline TriangleMesh cut_out(int cells, const std::function<bool(double x, double y)>& inside) {
  const TriangleMesh square = structured_mesh(cells, {0});
  std::vector<int> kept, number(square.vertex_count(), -1), owners(square.edge_count(), 0);
  for (int t = 0; t < square.triangle_count(); ++t) {
    Eigen::RowVector2d centroid = Eigen::RowVector2d::Zero();
    for (int i = 0; i < 3; ++i) centroid += square.vertices.row(square.triangles(t, i)) / 3;
    if (inside(centroid(0), centroid(1))) kept.push_back(t);
  }
  Triples triangles(static_cast<Eigen::Index>(kept.size()), 3);
  Points vertices(square.vertex_count(), 2);
  int used = 0;
  for (std::size_t k = 0; k < kept.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      const int v = square.triangles(kept[k], i);
      if (number[v] < 0) vertices.row(number[v] = used++) = square.vertices.row(v);
      triangles(static_cast<Eigen::Index>(k), i) = number[v];
      ++owners[square.triangle_edges(kept[k], i)];
    }
  vertices.conservativeResize(used, 2);
  std::vector<TaggedEdge> tagged;
  for (int e = 0; e < square.edge_count(); ++e) {
    if (owners[e] != 1) continue;
    const int from = square.edges(e, 0), to = square.edges(e, 1);
    const bool on_sigma = square.vertices(from, 1) == 0 && square.vertices(to, 1) == 0;
    tagged.push_back({number[from], number[to], on_sigma ? EdgeTag::contact : EdgeTag::clamped});
  }
  return make_triangle_mesh(vertices, triangles, std::vector<Region>(kept.size(), Region::body), tagged, "cut out");
}

/// An L over the whole of Sigma, re-entrant corner at (1/2, 1/2).
inline TriangleMesh l_shape(int cells) {
  return cut_out(cells, [](double x, double y) { return x < 0.5 || y < 0.5; });
}
/// A bridge: Sigma in two pieces, each of length 1/4, under the feet of a body 1 x 1 less 1/2 x 1/2.
inline TriangleMesh bridge(int cells) {
  return cut_out(cells, [](double x, double y) { return y > 0.5 || x < 0.25 || x > 0.75; });
}

}  // namespace antilock::test
