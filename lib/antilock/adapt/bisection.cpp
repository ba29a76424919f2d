#include "antilock/adapt/bisection.hpp"

#include <algorithm>

#include "antilock/core/error.hpp"
#include "antilock/mesh/refine.hpp"

namespace antilock {
namespace {

/// Halving an edge forces the triangles beside it to be halved from their newest vertex first:
/// marks spread until every triangle with a marked edge has its edge 0 marked.
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

/// Per edge: whether it is halved. All edges of a marked triangle are.
std::vector<char> edges_to_halve(const TriangleMesh& mesh, const std::vector<bool>& triangles,
                                 const std::vector<bool>& edges) {
  std::vector<char> marked(mesh.edge_count(), 0);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (!triangles[t]) continue;
    for (const int e : mesh.triangle_edges.row(t)) marked[e] = 1;
  }
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e]) marked[e] = 1;
  close_marks(mesh, marked);
  return marked;
}

/// The vertices of the finer mesh, those of the mesh first, and its tagged edges.
struct HalvedEdges {
  Points vertices;
  std::vector<int> middle;  ///< per edge of the mesh: the vertex in its middle, or -1
  std::vector<TaggedEdge> tagged;
};

HalvedEdges halved_edges(const TriangleMesh& mesh, const std::vector<char>& marked) {
  const auto halved = static_cast<int>(std::count(marked.begin(), marked.end(), 1));
  HalvedEdges finer;
  finer.vertices.resize(mesh.vertex_count() + halved, 2);
  finer.vertices.topRows(mesh.vertex_count()) = mesh.vertices;
  finer.middle.assign(mesh.edge_count(), -1);
  int next = mesh.vertex_count();
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int from = mesh.edges(e, 0);
    const int to = mesh.edges(e, 1);
    const EdgeTag tag = mesh.edge_tag[e];
    if (marked[e]) {
      finer.vertices.row(next) = 0.5 * (mesh.vertices.row(from) + mesh.vertices.row(to));
      finer.middle[e] = next;
      ++next;
    }
    if (tag == EdgeTag::interior) continue;
    if (marked[e]) {
      finer.tagged.push_back({from, finer.middle[e], tag});
      finer.tagged.push_back({finer.middle[e], to, tag});
    } else {
      finer.tagged.push_back({from, to, tag});
    }
  }
  follow_geometry(mesh, finer.middle, finer.vertices);
  return finer;
}

/// The triangles of the finer mesh, while they are made. Each takes over region and column of its
/// parent.
class Children {
 public:
  Children(const TriangleMesh& mesh, const std::vector<int>& middle)
      : mesh_(mesh), middle_(middle), corners_(4 * mesh.triangle_count(), 3) {
    for (int t = 0; t < mesh.triangle_count(); ++t) add_children(t);
    corners_.conservativeResize(static_cast<Eigen::Index>(region_.size()), 3);
  }

  Triples& corners() { return corners_; }
  std::vector<Region>& region() { return region_; }
  std::vector<CurvedColumn>& columns() { return columns_; }

 private:
  /// The vertex in the middle of edge i of triangle t, or -1.
  int middle(int t, int i) const { return middle_[mesh_.triangle_edges(t, i)]; }

  void add(int t, int a, int b, int c) {
    corners_.row(static_cast<Eigen::Index>(region_.size())) << a, b, c;
    region_.push_back(mesh_.region[t]);
    if (mesh_.curved()) columns_.push_back(mesh_.curved_columns[t]);
  }

  void add_children(int t) {
    const auto v = mesh_.triangles.row(t);
    const int m = middle(t, 0);
    if (m < 0) {
      add(t, v(0), v(1), v(2));
      return;
    }
    const int m1 = middle(t, 1);
    const int m2 = middle(t, 2);
    if (m1 >= 0 && m2 >= 0) {  // four triangles like the whole, their edges 0 parallel to its own
      add(t, v(0), m2, m1);
      add(t, m2, v(1), m);
      add(t, m1, m, v(2));
      add(t, m, m1, m2);
      return;
    }
    // the halves (m, v0, v1) and (m, v2, v0), whose edges 0 are the edges 2 and 1 of the whole
    add_half(t, m, v(0), v(1), m2);
    add_half(t, m, v(2), v(0), m1);
  }

  /// The half (m, from, to), or its halves where the middle n of its edge 0 is a vertex.
  void add_half(int t, int m, int from, int to, int n) {
    if (n < 0) {
      add(t, m, from, to);
      return;
    }
    add(t, n, m, from);
    add(t, n, to, m);
  }

  const TriangleMesh& mesh_;
  const std::vector<int>& middle_;
  Triples corners_;
  std::vector<Region> region_;
  std::vector<CurvedColumn> columns_;
};

}  // namespace

TriangleMesh bisected(const TriangleMesh& mesh, const std::vector<bool>& triangles,
                      const std::vector<bool>& edges) {
  require_triangles(mesh, "bisected mesh");
  const bool one_per_triangle = static_cast<int>(triangles.size()) == mesh.triangle_count();
  const bool one_per_edge = static_cast<int>(edges.size()) == mesh.edge_count();
  if (!one_per_triangle || (!edges.empty() && !one_per_edge))
    throw Error("bisection: accepted: one mark per triangle, one per edge or none");
  HalvedEdges halved = halved_edges(mesh, edges_to_halve(mesh, triangles, edges));
  Children children(mesh, halved.middle);
  TriangleMesh finer = make_mesh(std::move(halved.vertices), std::move(children.corners()),
                                 std::move(children.region()), halved.tagged,
                                 refinement_name(mesh, "bisected mesh"));
  finer.geometry = mesh.geometry;
  finer.curved_columns = std::move(children.columns());
  return finer;
}

TriangleMesh longest_edge_first(TriangleMesh mesh) {
  require_triangles(mesh, "longest edges first");
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    int longest = 0;
    for (int i = 1; i < 3; ++i)
      if (mesh.edge_length(mesh.triangle_edges(t, i)) >
          mesh.edge_length(mesh.triangle_edges(t, longest)))
        longest = i;
    const Eigen::RowVector3i v = mesh.triangles.row(t);
    const Eigen::RowVector3i e = mesh.triangle_edges.row(t);
    for (int i = 0; i < 3; ++i) {
      mesh.triangles(t, i) = v((longest + i) % 3);
      mesh.triangle_edges(t, i) = e((longest + i) % 3);
    }
  }
  return mesh;
}

}  // namespace antilock
