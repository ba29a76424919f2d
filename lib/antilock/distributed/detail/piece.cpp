#include "antilock/distributed/detail/piece.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "antilock/core/error.hpp"

namespace antilock::distributed {
namespace {

constexpr double slack = 1e-9;  // between abscissae that are meant to be the same

/// The vertical lines of the layer, by x; without a layer, those of the contact edges; else those of all vertices.
std::vector<double> column_lines(const TriangleMesh& mesh) {
  std::vector<double> x;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == EdgeTag::contact)
      for (int i = 0; i < 2; ++i) x.push_back(mesh.vertices(mesh.edges(e, i), 0));
  if (x.empty()) x.assign(mesh.vertices.col(0).begin(), mesh.vertices.col(0).end());
  std::sort(x.begin(), x.end());
  x.erase(std::unique(x.begin(), x.end(), [](double a, double b) { return b - a < slack; }), x.end());
  return x;
}

int column_at(const std::vector<double>& lines, double x) {
  const auto after = std::upper_bound(lines.begin(), lines.end(), x) - lines.begin();
  return static_cast<int>(std::clamp<std::ptrdiff_t>(after - 1, 0, static_cast<std::ptrdiff_t>(lines.size()) - 2));
}

/// New numbers, in the old order, for what is marked; -1 for the rest.
std::vector<int> renumbered(const std::vector<char>& marked) {
  std::vector<int> number;
  int count = 0;
  for (const char mark : marked) number.push_back(mark != 0 ? count++ : -1);
  return number;
}

/// Throws Error where two ranks meet at a vertex and at no edge of it: by their common edges they know what they share.
void check_meetings(const TriangleMesh& mesh, const std::vector<int>& rank_of) {
  std::vector<std::set<int>> by_triangles(mesh.vertex_count()), by_edges(mesh.vertex_count());
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (const int v : mesh.triangles.row(t)) by_triangles[v].insert(rank_of[t]);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_triangles(e, 1) < 0) continue;
    const int one = rank_of[mesh.edge_triangles(e, 0)], other = rank_of[mesh.edge_triangles(e, 1)];
    for (const int v : mesh.edges.row(e))
      if (one != other) by_edges[v].insert({one, other});
  }
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (by_triangles[v].size() > 1 && by_triangles[v] != by_edges[v])
      throw Error(fmt::format(
          "parts of the body touch at the point ({:.6g}, {:.6g}) alone, and two ranks meet there; accepted: "
          "fewer ranks, or parts that meet along edges",
          mesh.vertices(v, 0), mesh.vertices(v, 1)));
}

/// edge_triangles from triangle_edges.
void look_back(TriangleMesh& mesh) {
  mesh.edge_triangles = Pairs::Constant(mesh.edges.rows(), 2, -1);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int e = mesh.triangle_edges(t, i);
      mesh.edge_triangles(e, mesh.edge_triangles(e, 0) < 0 ? 0 : 1) = t;
    }
}

}  // namespace

std::vector<int> strips(const TriangleMesh& mesh, int ranks, bool any_layer) {
  const std::vector<double> lines = column_lines(mesh);
  const int columns = static_cast<int>(lines.size()) - 1;
  if (columns < ranks)
    throw Error(
        fmt::format("{} ranks for {} columns of the layer; accepted: a column or more per rank (start fewer "
                    "ranks, or ask for more cells)",
                    ranks, columns));
  std::vector<int> column(mesh.triangle_count()), filled(columns, 0);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Vector3d x = mesh.vertices.col(0)(mesh.triangles.row(t));
    column[t] = column_at(lines, x.mean());
    ++filled[column[t]];
    if (any_layer || mesh.region[t] != Region::layer) continue;
    const double left = lines[column[t]], right = lines[column[t] + 1];
    if (x.minCoeff() < left - slack || x.maxCoeff() > right + slack)
      throw Error(
          fmt::format("the layer's triangle at ({:.6g}, {:.6g}) crosses a vertical line through the vertices "
                      "of the contact edges: the layer is not made of columns, and multigrid fails on it; "
                      "accepted: kind = \"layered\" or \"structured\", or --direct (MUMPS)",
                      x.mean(), mesh.vertices.col(1)(mesh.triangles.row(t)).mean()));
  }
  // a strip ends at the column that brings the triangles up to its share, and leaves a column to each rank to come
  std::vector<int> rank_of(columns);
  long long before = 0;
  for (int c = 0, rank = 0, own = 0; c < columns; ++c) {
    const bool full = (before + filled[c] / 2) * ranks >= static_cast<long long>(rank + 1) * mesh.triangle_count();
    const bool last_chance = columns - c == ranks - rank - 1;
    if (own > 0 && rank + 1 < ranks && (full || last_chance)) ++rank, own = 0;
    rank_of[c] = rank;
    ++own;
    before += filled[c];
  }
  for (int& c : column) c = rank_of[c];
  return column;
}

TriangleMesh piece_of(const TriangleMesh& coarse, const std::vector<int>& rank_of, int rank) {
  check_meetings(coarse, rank_of);
  std::vector<char> vertex_here(coarse.vertex_count(), 0), edge_here(coarse.edge_count(), 0);
  std::vector<int> triangles;
  for (int t = 0; t < coarse.triangle_count(); ++t) {
    if (rank_of[t] != rank) continue;
    triangles.push_back(t);
    for (int i = 0; i < 3; ++i) vertex_here[coarse.triangles(t, i)] = edge_here[coarse.triangle_edges(t, i)] = 1;
  }
  const std::vector<int> vertex = renumbered(vertex_here), edge = renumbered(edge_here);

  TriangleMesh piece;
  piece.vertices.resize(std::count(vertex_here.begin(), vertex_here.end(), 1), 2);
  for (int v = 0; v < coarse.vertex_count(); ++v)
    if (vertex[v] >= 0) piece.vertices.row(vertex[v]) = coarse.vertices.row(v);
  piece.edges.resize(std::count(edge_here.begin(), edge_here.end(), 1), 2);
  for (int e = 0; e < coarse.edge_count(); ++e) {
    if (edge[e] < 0) continue;
    piece.edges.row(edge[e]) << vertex[coarse.edges(e, 0)], vertex[coarse.edges(e, 1)];
    piece.edge_tag.push_back(coarse.edge_tag[e]);
  }
  const auto count = static_cast<Eigen::Index>(triangles.size());
  piece.triangles.resize(count, 3), piece.triangle_edges.resize(count, 3);
  for (Eigen::Index t = 0; t < count; ++t) {
    piece.region.push_back(coarse.region[triangles[t]]);
    for (int i = 0; i < 3; ++i) {
      piece.triangles(t, i) = vertex[coarse.triangles(triangles[t], i)];
      piece.triangle_edges(t, i) = edge[coarse.triangle_edges(triangles[t], i)];
    }
  }
  look_back(piece);
  return piece;
}

TriangleMesh refined_piece(const TriangleMesh& mesh) {
  const int corners = mesh.vertex_count(), edges = mesh.edge_count(), triangles = mesh.triangle_count();
  // the midpoint of edge e becomes vertex corners + e; its halves become edges 2 e (at edges(e, 0)) and 2 e + 1;
  // inside triangle t, the edge that cuts off corner i becomes edge 2 edges + 3 t + i
  const auto half = [&](int e, int vertex) { return mesh.edges(e, 0) == vertex ? 2 * e : 2 * e + 1; };
  TriangleMesh cut;
  cut.vertices.resize(corners + edges, 2), cut.vertices.topRows(corners) = mesh.vertices;
  cut.edges.resize(2 * edges + 3 * triangles, 2);
  cut.edge_tag.assign(cut.edges.rows(), EdgeTag::interior);
  for (int e = 0; e < edges; ++e) {
    cut.vertices.row(corners + e) = 0.5 * (mesh.vertices.row(mesh.edges(e, 0)) + mesh.vertices.row(mesh.edges(e, 1)));
    for (int i = 0; i < 2; ++i) {
      cut.edges.row(2 * e + i) << mesh.edges(e, i), corners + e;
      cut.edge_tag[2 * e + i] = mesh.edge_tag[e];
    }
  }
  cut.triangles.resize(4 * triangles, 3), cut.triangle_edges.resize(4 * triangles, 3);
  cut.region.resize(4 * static_cast<std::size_t>(triangles));
  for (int t = 0; t < triangles; ++t) {
    const int inner = 2 * edges + 3 * t;
    const Eigen::RowVector3i v = mesh.triangles.row(t), e = mesh.triangle_edges.row(t), m = e.array() + corners;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      cut.triangles.row(4 * t + i) << v(i), m(k), m(j);
      cut.triangle_edges.row(4 * t + i) << inner + i, half(e(j), v(i)), half(e(k), v(i));
      cut.edges.row(inner + i) << std::min(m(j), m(k)), std::max(m(j), m(k));
    }
    cut.triangles.row(4 * t + 3) = m;
    cut.triangle_edges.row(4 * t + 3) << inner, inner + 1, inner + 2;
    std::fill_n(cut.region.begin() + 4 * static_cast<std::ptrdiff_t>(t), 4, mesh.region[t]);
  }
  look_back(cut);
  return cut;
}

}  // namespace antilock::distributed
