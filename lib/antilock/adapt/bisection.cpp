#include "antilock/adapt/bisection.hpp"

#include <algorithm>
#include <array>

#include "antilock/core/error.hpp"
#include "antilock/mesh/refine.hpp"

namespace antilock {
namespace {

/// Halving an edge forces the triangles beside it to be halved from their newest vertex first: marks spread until every
/// triangle with a marked edge has its edge 0 marked.
void close_marks(const TriangleMesh& mesh, std::vector<char>& marked) {
  std::vector<int> waiting;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (marked[e]) waiting.push_back(e);
  while (!waiting.empty()) {
    const int e = waiting.back();
    waiting.pop_back();
    for (int side = 0; side < 2; ++side) {
      const int t = mesh.edge_triangles(e, side);
      if (t < 0 || marked[mesh.triangle_edges(t, 0)]) continue;
      marked[mesh.triangle_edges(t, 0)] = 1;
      waiting.push_back(mesh.triangle_edges(t, 0));
    }
  }
}

}  // namespace

TriangleMesh bisected(const TriangleMesh& mesh, const std::vector<bool>& triangles, const std::vector<bool>& edges) {
  if (static_cast<int>(triangles.size()) != mesh.triangle_count() ||
      (!edges.empty() && static_cast<int>(edges.size()) != mesh.edge_count()))
    throw Error("bisection: accepted: one mark per triangle, one per edge or none");
  std::vector<char> marked(mesh.edge_count(), 0);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (triangles[t])
      for (int i = 0; i < 3; ++i) marked[mesh.triangle_edges(t, i)] = 1;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e]) marked[e] = 1;
  close_marks(mesh, marked);

  const auto halved = static_cast<int>(std::count(marked.begin(), marked.end(), 1));
  Points vertices(mesh.vertex_count() + halved, 2);
  vertices.topRows(mesh.vertex_count()) = mesh.vertices;
  std::vector<int> middle(mesh.edge_count(), -1);
  std::vector<TaggedEdge> tagged;
  int next = mesh.vertex_count();
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int from = mesh.edges(e, 0), to = mesh.edges(e, 1);
    const EdgeTag tag = mesh.edge_tag[e];
    if (marked[e]) {
      vertices.row(next) = 0.5 * (mesh.vertices.row(from) + mesh.vertices.row(to));
      middle[e] = next++;
      if (tag != EdgeTag::interior) tagged.insert(tagged.end(), {{from, middle[e], tag}, {middle[e], to, tag}});
    } else if (tag != EdgeTag::interior) {
      tagged.push_back({from, to, tag});
    }
  }

  follow_geometry(mesh, middle, vertices);

  Triples corners(4 * mesh.triangle_count(), 3);
  std::vector<Region> region;
  std::vector<CurvedColumn> column;
  const auto add = [&](int t, int a, int b, int c) {
    corners.row(static_cast<Eigen::Index>(region.size())) << a, b, c;
    region.push_back(mesh.region[t]);
    if (mesh.curved()) column.push_back(mesh.curved_columns[t]);
  };
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const auto v = mesh.triangles.row(t);
    const int m = middle[mesh.triangle_edges(t, 0)];
    if (m < 0) {
      add(t, v(0), v(1), v(2));
      continue;
    }
    const int m1 = middle[mesh.triangle_edges(t, 1)], m2 = middle[mesh.triangle_edges(t, 2)];
    if (m1 >= 0 && m2 >= 0) {  // four triangles like the whole, their edges 0 parallel to its own
      add(t, v(0), m2, m1);
      add(t, m2, v(1), m);
      add(t, m1, m, v(2));
      add(t, m, m1, m2);
      continue;
    }
    // the halves (m, v0, v1) and (m, v2, v0), whose edges 0 are the edges 2 and 1 of the whole
    for (const auto& [from, to, edge] : {std::array{v(0), v(1), 2}, std::array{v(2), v(0), 1}}) {
      const int n = middle[mesh.triangle_edges(t, edge)];
      if (n < 0) {
        add(t, m, from, to);
      } else {
        add(t, n, m, from);
        add(t, n, to, m);
      }
    }
  }
  corners.conservativeResize(static_cast<Eigen::Index>(region.size()), 3);
  TriangleMesh finer = make_triangle_mesh(std::move(vertices), std::move(corners), std::move(region), tagged,
                                          refinement_name(mesh, "bisected mesh"));
  finer.geometry = mesh.geometry;
  finer.curved_columns = std::move(column);
  return finer;
}

TriangleMesh longest_edge_first(TriangleMesh mesh) {
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    int longest = 0;
    for (int i = 1; i < 3; ++i)
      if (mesh.edge_length(mesh.triangle_edges(t, i)) > mesh.edge_length(mesh.triangle_edges(t, longest))) longest = i;
    const Eigen::RowVector3i v = mesh.triangles.row(t), e = mesh.triangle_edges.row(t);
    for (int i = 0; i < 3; ++i) {
      mesh.triangles(t, i) = v((longest + i) % 3);
      mesh.triangle_edges(t, i) = e((longest + i) % 3);
    }
  }
  return mesh;
}

}  // namespace antilock
