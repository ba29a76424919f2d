#pragma once
#include <algorithm>
#include <map>

#include "antilock/mesh/generate.hpp"

namespace antilock::distributed {

/// The body meshed by gmsh, the layer below it in columns: one per edge of the body on Sigma, `cells` rows.
inline TriangleMesh layered_mesh(int cells) {
  const TriangleMesh body = unstructured_mesh(cells, {0});
  std::vector<int> top;
  for (int v = 0; v < body.vertex_count(); ++v)
    if (body.vertices(v, 1) == 0) top.push_back(v);
  std::sort(top.begin(), top.end(), [&](int a, int b) { return body.vertices(a, 0) < body.vertices(b, 0); });
  const int columns = static_cast<int>(top.size()) - 1, above = body.vertex_count();
  const auto vertex = [&](int column, int row) {
    return row == 0 ? top[column] : above + (row - 1) * (columns + 1) + column;
  };
  Points vertices(above + cells * (columns + 1), 2);
  vertices.topRows(above) = body.vertices;
  for (int row = 1; row <= cells; ++row)
    for (int c = 0; c <= columns; ++c)
      vertices.row(vertex(c, row)) << body.vertices(top[c], 0), -static_cast<double>(row) / cells;
  Triples triangles(body.triangle_count() + 2 * columns * cells, 3);
  triangles.topRows(body.triangle_count()) = body.triangles;
  int t = body.triangle_count();
  for (int row = 0; row < cells; ++row)
    for (int c = 0; c < columns; ++c) {
      triangles.row(t++) << vertex(c, row), vertex(c, row + 1), vertex(c + 1, row + 1);
      triangles.row(t++) << vertex(c, row), vertex(c + 1, row + 1), vertex(c + 1, row);
    }
  std::vector<Region> region = body.region;
  region.resize(triangles.rows(), Region::layer);
  std::vector<TaggedEdge> tags;
  for (int e = 0; e < body.edge_count(); ++e)
    if (body.edge_tag[e] == EdgeTag::clamped) tags.push_back({body.edges(e, 0), body.edges(e, 1), EdgeTag::clamped});
  for (int row = 0; row < cells; ++row)
    for (const int c : {0, columns}) tags.push_back({vertex(c, row), vertex(c, row + 1), EdgeTag::clamped});
  for (int c = 0; c < columns; ++c) tags.push_back({vertex(c, cells), vertex(c + 1, cells), EdgeTag::contact});
  return make_triangle_mesh(std::move(vertices), std::move(triangles), std::move(region), tags, "layered mesh");
}

}  // namespace antilock::distributed
