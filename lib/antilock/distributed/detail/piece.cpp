#include "antilock/distributed/detail/piece.hpp"

#include <algorithm>
#include <set>

namespace antilock::distributed {
namespace {

/// New numbers, in the old order, for what is marked; -1 for the rest.
std::vector<int> renumbered(const std::vector<char>& marked, int& count) {
  std::vector<int> number(marked.size(), -1);
  count = 0;
  for (std::size_t i = 0; i < marked.size(); ++i)
    if (marked[i] != 0) number[i] = count++;
  return number;
}

std::vector<char> vertices_with(const TriangleMesh& mesh, EdgeTag tag) {
  std::vector<char> marked(mesh.vertex_count(), 0);
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == tag) marked[mesh.edges(e, 0)] = marked[mesh.edges(e, 1)] = 1;
  return marked;
}

}  // namespace

MeshPart piece_of(const TriangleMesh& coarse, const std::vector<int>& owner_of, int rank, int ranks) {
  std::vector<char> vertex_here(coarse.vertex_count(), 0), edge_here(coarse.edge_count(), 0);
  std::vector<std::set<int>> holders(coarse.vertex_count());  // ranks at each vertex
  std::vector<int> triangles;
  for (int t = 0; t < coarse.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) holders[coarse.triangles(t, i)].insert(owner_of[t]);
    if (owner_of[t] != rank) continue;
    triangles.push_back(t);
    for (int i = 0; i < 3; ++i) vertex_here[coarse.triangles(t, i)] = edge_here[coarse.triangle_edges(t, i)] = 1;
  }
  int vertex_count = 0, edge_count = 0;
  const std::vector<int> vertex = renumbered(vertex_here, vertex_count), edge = renumbered(edge_here, edge_count);

  MeshPart piece;
  TriangleMesh& mesh = piece.mesh;
  mesh.vertices.resize(vertex_count, 2);
  for (int v = 0; v < coarse.vertex_count(); ++v)
    if (vertex[v] >= 0) mesh.vertices.row(vertex[v]) = coarse.vertices.row(v);
  const auto count = static_cast<Eigen::Index>(triangles.size());
  mesh.triangles.resize(count, 3), mesh.triangle_edges.resize(count, 3);
  mesh.edges.resize(edge_count, 2), mesh.edge_triangles = Pairs::Constant(edge_count, 2, -1);
  mesh.edge_tag.resize(edge_count);
  for (int t = 0; t < count; ++t) {
    mesh.region.push_back(coarse.region[triangles[t]]);
    for (int i = 0; i < 3; ++i) {
      const int e = edge[coarse.triangle_edges(triangles[t], i)];
      mesh.triangles(t, i) = vertex[coarse.triangles(triangles[t], i)];
      mesh.triangle_edges(t, i) = e;
      mesh.edge_triangles(e, mesh.edge_triangles(e, 0) < 0 ? 0 : 1) = t;
    }
  }

  const std::vector<char> clamped = vertices_with(coarse, EdgeTag::clamped),
                          contact = vertices_with(coarse, EdgeTag::contact);
  piece.corner_count.assign(ranks, 0), piece.corner_rows.assign(ranks, 0);
  for (int v = 0; v < coarse.vertex_count(); ++v) {
    if (vertex[v] >= 0 && clamped[v] != 0) piece.clamped.push_back(vertex[v]);
    if (vertex[v] >= 0 && contact[v] != 0) piece.contact.push_back(vertex[v]);
    if (holders[v].size() < 2) continue;
    const int owner = *holders[v].begin(), index = piece.corner_count[owner]++;
    const int row = clamped[v] != 0 ? -1 : piece.corner_rows[owner]++;
    if (vertex[v] >= 0) piece.corners.push_back({vertex[v], owner, index, row});
  }
  std::vector<int> seams(ranks, 0);
  for (int e = 0; e < coarse.edge_count(); ++e) {
    if (edge[e] >= 0) {
      mesh.edges.row(edge[e]) << vertex[coarse.edges(e, 0)], vertex[coarse.edges(e, 1)];
      mesh.edge_tag[edge[e]] = coarse.edge_tag[e];
    }
    if (coarse.edge_triangles(e, 1) < 0) continue;
    const auto [low, high] = std::minmax(owner_of[coarse.edge_triangles(e, 0)], owner_of[coarse.edge_triangles(e, 1)]);
    if (low == high) continue;
    const int index = seams[low]++;
    if (edge[e] >= 0)
      piece.seams.push_back({low, index, {vertex[coarse.edges(e, 0)], vertex[coarse.edges(e, 1)]}, {edge[e]}});
  }
  return piece;
}

MeshPart refined(const MeshPart& piece) {
  const TriangleMesh& mesh = piece.mesh;
  const int corners = mesh.vertex_count(), edges = mesh.edge_count(), triangles = mesh.triangle_count();
  // the midpoint of edge e becomes vertex corners + e; its halves become edges 2 e (at edges(e, 0)) and 2 e + 1;
  // inside triangle t, the edge that cuts off corner i becomes edge 2 edges + 3 t + i
  const auto half = [&](int e, int vertex) { return mesh.edges(e, 0) == vertex ? 2 * e : 2 * e + 1; };
  MeshPart fine{{},           piece.level + 1, piece.corners, {}, piece.corner_count, piece.corner_rows, piece.clamped,
                piece.contact};
  TriangleMesh& cut = fine.mesh;
  cut.vertices.resize(corners + edges, 2), cut.vertices.topRows(corners) = mesh.vertices;
  const int edge_count = 2 * edges + 3 * triangles;
  cut.edges.resize(edge_count, 2), cut.edge_triangles = Pairs::Constant(edge_count, 2, -1);
  cut.edge_tag.assign(edge_count, EdgeTag::interior);
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
  for (int t = 0; t < cut.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int e = cut.triangle_edges(t, i);
      cut.edge_triangles(e, cut.edge_triangles(e, 0) < 0 ? 0 : 1) = t;
    }
  for (const Seam& seam : piece.seams) {
    Seam finer{seam.owner, seam.index, {seam.vertices.front()}, {}};
    for (std::size_t s = 0; s < seam.edges.size(); ++s) {
      const int e = seam.edges[s], from = seam.vertices[s], to = seam.vertices[s + 1];
      finer.vertices.insert(finer.vertices.end(), {corners + e, to});
      finer.edges.insert(finer.edges.end(), {half(e, from), half(e, to)});
    }
    fine.seams.push_back(std::move(finer));
  }
  return fine;
}

}  // namespace antilock::distributed
