#include "antilock/distributed/partition.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "antilock/core/error.hpp"

namespace antilock::distributed {
namespace {

/// Abscissae that are meant to be the same are so near.
double rounding(const TriangleMesh& mesh) { return 1e-9 * body_size(mesh); }

/// The vertical lines of the layer, by x; without a layer, those of the contact edges; else those
/// of all vertices.
std::vector<double> column_lines(const TriangleMesh& mesh) {
  std::vector<double> x;
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == EdgeTag::contact)
      for (int i = 0; i < 2; ++i) x.push_back(mesh.vertices(mesh.edges(e, i), 0));
  if (x.empty()) x.assign(mesh.vertices.col(0).begin(), mesh.vertices.col(0).end());
  std::sort(x.begin(), x.end());
  x.erase(std::unique(x.begin(), x.end(),
                      [off = rounding(mesh)](double a, double b) { return b - a < off; }),
          x.end());
  return x;
}

/// The column of every triangle, by its centroid.
std::vector<int> column_of_triangles(const TriangleMesh& mesh, const std::vector<double>& lines) {
  const int last = static_cast<int>(lines.size()) - 2;
  std::vector<int> column;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const double x = mesh.vertices.col(0)(mesh.triangles.row(t)).mean();
    const auto after =
        static_cast<int>(std::upper_bound(lines.begin(), lines.end(), x) - lines.begin());
    column.push_back(std::clamp(after - 1, 0, last));
  }
  return column;
}

}  // namespace

int find_triangle_across_columns(const TriangleMesh& mesh) {
  require_triangles(mesh, "columns of the layer");
  const std::vector<double> lines = column_lines(mesh);
  if (lines.size() < 2) return -1;
  const std::vector<int> column = column_of_triangles(mesh, lines);
  const double off = rounding(mesh);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != Region::layer) continue;
    const Eigen::Vector3d x = mesh.vertices.col(0)(mesh.triangles.row(t));
    if (x.minCoeff() < lines[column[t]] - off || x.maxCoeff() > lines[column[t] + 1] + off)
      return t;
  }
  return -1;
}

std::vector<int> strip_partition(const TriangleMesh& mesh, int ranks) {
  require_triangles(mesh, "partition into strips");
  const std::vector<double> lines = column_lines(mesh);
  const int columns = static_cast<int>(lines.size()) - 1;
  if (columns < ranks)
    throw Error(fmt::format(
        "{} ranks for {} columns of the layer; accepted: a column or more per rank (start fewer "
        "ranks, or ask for more cells)",
        ranks, columns));
  std::vector<int> column = column_of_triangles(mesh, lines);
  std::vector<int> filled(columns, 0);
  for (const int c : column) ++filled[c];
  // a strip ends at the column that brings the triangles up to its share, and leaves a column to
  // each rank to come
  std::vector<int> rank_of(columns);
  long long before = 0;
  for (int c = 0, rank = 0, own = 0; c < columns; ++c) {
    const bool full = (before + filled[c] / 2) * ranks >=
                      static_cast<long long>(rank + 1) * mesh.triangle_count();
    const bool last_chance = columns - c == ranks - rank - 1;
    if (own > 0 && rank + 1 < ranks && (full || last_chance)) {
      ++rank;
      own = 0;
    }
    rank_of[c] = rank;
    ++own;
    before += filled[c];
  }
  for (int& c : column) c = rank_of[c];
  return column;
}

TriangleMesh subdomain_of(const TriangleMesh& coarse, const std::vector<int>& rank_of, int rank) {
  require_triangles(coarse, "subdomain");
  TriangleMesh subdomain;
  std::vector<int> triangles, vertices, number(coarse.vertex_count(), -1);
  for (int t = 0; t < coarse.triangle_count(); ++t) {
    if (rank_of[t] != rank) continue;
    triangles.push_back(t);
    subdomain.region.push_back(coarse.region[t]);
    for (const int v : coarse.triangles.row(t)) number[v] = 0;
  }
  for (int v = 0; v < coarse.vertex_count(); ++v) {
    if (number[v] != 0) continue;
    number[v] = static_cast<int>(vertices.size());
    vertices.push_back(v);
  }
  subdomain.vertices = coarse.vertices(vertices, Eigen::indexing::all);
  subdomain.triangles =
      coarse.triangles(triangles, Eigen::indexing::all).unaryExpr([&](int v) { return number[v]; });
  number_edges(subdomain, "a subdomain of the mesh");
  for (int t = 0; t < subdomain.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i)
      subdomain.edge_tag[subdomain.triangle_edges(t, i)] =
          coarse.edge_tag[coarse.triangle_edges(triangles[t], i)];
  return subdomain;
}

TriangleMesh refined_subdomain(const TriangleMesh& mesh) {
  require_triangles(mesh, "refined subdomain");
  const int corners = mesh.vertex_count();  // the midpoint of edge e becomes vertex corners + e
  TriangleMesh cut;
  cut.vertices.resize(corners + mesh.edge_count(), 2);
  cut.vertices.topRows(corners) = mesh.vertices;
  for (int e = 0; e < mesh.edge_count(); ++e)
    cut.vertices.row(corners + e) =
        0.5 * (mesh.vertices.row(mesh.edges(e, 0)) + mesh.vertices.row(mesh.edges(e, 1)));
  cut.triangles.resize(4 * mesh.triangles.rows(), 3);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::RowVector3i v = mesh.triangles.row(t).head<3>();
    const Eigen::RowVector3i m = mesh.triangle_edges.row(t).head<3>().array() + corners;
    for (int i = 0; i < 3; ++i)
      cut.triangles.row(4 * t + i) << v(i), m((i + 2) % 3), m((i + 1) % 3);
    cut.triangles.row(4 * t + 3) << m(0), m(1), m(2);
    cut.region.insert(cut.region.end(), 4, mesh.region[t]);
  }
  number_edges(cut, "a subdomain of the mesh");
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3;
         ++i)  // the edges 1 and 2 of child i are halves of its parent's edges i + 1 and i + 2
      for (const int k : {1, 2})
        cut.edge_tag[cut.triangle_edges(4 * t + i, k)] =
            mesh.edge_tag[mesh.triangle_edges(t, (i + k) % 3)];
  return cut;
}

}  // namespace antilock::distributed
