// The third mesh: a body as gmsh likes it, a layer in columns, as Figure 3 has them.
#include "antilock/mesh/layered.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/mesh/generate.hpp"

namespace antilock {
namespace {

constexpr double on_line = 1e-9;  // of the body's size: gmsh places points of a line to about 1e-12

using SigmaEdges = std::vector<std::array<int, 2>>;  // their vertices, each from left to right

/// The edges of Sigma.
SigmaEdges sigma_edges(const TriangleMesh& mesh, bool along_normals) {
  const double off = on_line * body_size(mesh);
  SigmaEdges edges;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    std::array<int, 2> ends{mesh.edges(e, 0), mesh.edges(e, 1)};
    if (mesh.vertices(ends[0], 0) > mesh.vertices(ends[1], 0)) std::swap(ends[0], ends[1]);
    for (const int v : ends)
      if (!along_normals && std::abs(mesh.vertices(v, 1)) > off)
        throw Error("extruded layer: Sigma has a vertex at " + mesh.location_text(v) +
                    "; accepted: Sigma on the line y = 0");
    const auto corners = mesh.triangles.row(mesh.edge_triangles(e, 0));
    const Eigen::RowVector2d from = mesh.vertices.row(ends[0]);
    const Eigen::RowVector2d along = mesh.vertices.row(ends[1]) - from;
    const Eigen::RowVector2d up =
        mesh.vertices(corners, Eigen::indexing::all).colwise().mean() - from;
    if (along_normals && along(0) * up(1) <= along(1) * up(0))
      throw Error("extruded layer: the body is not above its contact edge at " +
                  mesh.location_text(ends[0]) + "; accepted: edges with the body above them");
    edges.push_back(ends);
  }
  if (edges.empty())
    throw MeshError("extruded layer: the body has no edge in the group contact to stand on");
  return edges;
}

/// The curvature at the vertices of Sigma where two of its edges meet; 0 elsewhere. Throws where
/// extruded() says so.
Eigen::VectorXd curvatures(const TriangleMesh& mesh, SigmaEdges edges, double thickness) {
  const double off = on_line * body_size(mesh);
  const auto x = [&](int v) { return mesh.vertices(v, 0); };
  std::sort(edges.begin(), edges.end(),
            [&](const auto& a, const auto& b) { return x(a[0]) < x(b[0]); });
  Eigen::VectorXd turn = Eigen::VectorXd::Zero(mesh.vertex_count());
  Eigen::VectorXd length = turn;
  Eigen::VectorXd count = turn;
  double end = edges.empty() ? 0 : x(edges[0][0]);
  for (const auto& [left, right] : edges) {
    const Eigen::RowVector2d along = mesh.vertices.row(right) - mesh.vertices.row(left);
    if (x(left) < end - off || !(along(0) > 1e-6 * along.norm()))
      throw Error("extruded layer: Sigma has an edge at " + mesh.location_text(left) +
                  " that is vertical or above another; accepted: every x once");
    end = x(right);
    for (const int v : {left, right}) {
      turn(v) += (v == left ? 1 : -1) * std::atan2(along(1), along(0));
      length(v) += along.norm() / 2;
      ++count(v);
    }
  }
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    turn(v) = count(v) == 2 ? turn(v) / length(v) : 0;
    if (1 + thickness * turn(v) <= 0)
      throw Error(
          fmt::format("extruded layer: the layer, {:g} thick, meets itself at {}, where Sigma is a "
                      "hollow of radius "
                      "{:.3g}; accepted: a thickness below that",
                      thickness, mesh.location_text(v), -1 / turn(v)));
  }
  return turn;
}

void check_body(const TriangleMesh& body, double epsilon, bool along_normals) {
  if (!(epsilon >= 0 && epsilon <= 1))
    throw Error(fmt::format(
        "extruded layer: epsilon = {} is out of range; accepted 0 <= epsilon <= 1", epsilon));
  if (std::find(body.region.begin(), body.region.end(), Region::layer) != body.region.end())
    throw Error("extruded layer: the mesh has a layer; accepted: a body alone");
  const double off = on_line * body_size(body);
  for (int v = 0; v < body.vertex_count(); ++v)
    if (!along_normals && body.vertices(v, 1) < -off)
      throw Error("extruded layer: the body has a vertex at " + body.location_text(v) +
                  "; accepted: a body above y = 0");
}

/// As many rows as make square cells in a layer of thickness epsilon below edges of length h.
int row_count(const TriangleMesh& body, const SigmaEdges& edges, double epsilon) {
  double length = 0;
  for (const auto& [left, right] : edges)
    length += (body.vertices.row(right) - body.vertices.row(left)).norm();
  const double cells = epsilon * static_cast<double>(edges.size()) / length;  // epsilon / h
  return std::max(1, static_cast<int>(std::ceil(cells - 1e-9)));
}

/// The body and the columns below it, while they are made.
class Extrusion {
 public:
  Extrusion(const TriangleMesh& body, const SigmaEdges& edges, int rows)
      : body_(body),
        rows_(rows),
        below_(body.vertex_count(), -1),
        degree_(body.vertex_count(), 0),
        side_(body.vertex_count(), EdgeTag::free),
        vertices_(body.vertices.rowwise().begin(), body.vertices.rowwise().end()),
        triangles_(body.triangles.rowwise().begin(), body.triangles.rowwise().end()) {
    for (const auto& ends : edges)
      for (const int v : ends) ++degree_[v];
    add_body_edges();
  }

  /// Adds the vertices below each vertex of Sigma. The layer begins at y = 0, or at the vertex.
  void add_vertices(const SigmaEdges& edges, bool along_normals) {
    for (const auto& ends : edges)
      for (const int v : ends) {
        if (below_[v] >= 0) continue;
        below_[v] = static_cast<int>(vertices_.size());
        const double top = along_normals ? body_.vertices(v, 1) : 0;
        for (int j = 1; j <= rows_; ++j)
          vertices_.emplace_back(body_.vertices(v, 0), top - static_cast<double>(j) / rows_);
      }
  }

  /// Adds the triangles of the column below an edge, from Sigma down, and its edges on the
  /// boundary.
  void add_column(int left, int right) {
    for (int j = 0; j < rows_; ++j) {
      triangles_.emplace_back(vertex(left, j + 1), vertex(right, j + 1), vertex(right, j));
      triangles_.emplace_back(vertex(left, j + 1), vertex(right, j), vertex(left, j));
      for (const int v : {left, right})
        if (is_end(v)) tagged_.push_back({vertex(v, j), vertex(v, j + 1), side_[v]});
    }
    tagged_.push_back({vertex(left, 0), vertex(right, 0), EdgeTag::sigma});
    tagged_.push_back({vertex(left, rows_), vertex(right, rows_), EdgeTag::contact});
  }

  /// The column below an edge of a curved Sigma. Throws where a displacement is given at its end.
  CurvedColumn curved_column(int left, int right, const Eigen::VectorXd& curvature) const {
    const Eigen::RowVector2d along = body_.vertices.row(right) - body_.vertices.row(left);
    const double slope = along(1) / along(0);
    // the mean of the curvatures at its ends, of those that have one
    const int inner_ends =
        static_cast<int>(degree_[left] == 2) + static_cast<int>(degree_[right] == 2);
    const double mean = (curvature(left) + curvature(right)) / std::max(inner_ends, 1);
    for (const int v : {left, right})
      if (is_end(v) && side_[v].kind == EdgeTag::Kind::dirichlet)
        throw Error("extruded layer: a displacement is given at " + body_.location_text(v) +
                    ", where a curved Sigma ends; accepted: clamped or free there");
    return {body_.vertices(left, 1) - slope * body_.vertices(left, 0), slope, mean};
  }

  TriangleMesh mesh() const {
    std::vector<Region> region(body_.triangle_count(), Region::body);
    region.resize(triangles_.size(), Region::layer);
    const auto vertex_count = static_cast<Eigen::Index>(vertices_.size());
    const auto triangle_count = static_cast<Eigen::Index>(triangles_.size());
    return make_triangle_mesh(Eigen::Map<const Points>(vertices_[0].data(), vertex_count, 2),
                              Eigen::Map<const Triples>(triangles_[0].data(), triangle_count, 3),
                              region, tagged_, "extruded layer");
  }

 private:
  /// Takes over the edges of the body. Where the body is held beside Sigma, so is the layer.
  void add_body_edges() {
    for (int e = 0; e < body_.edge_count(); ++e) {
      const EdgeTag tag = body_.edge_tag[e];
      if (tag == EdgeTag::interior || tag == EdgeTag::contact) continue;
      tagged_.push_back({body_.edges(e, 0), body_.edges(e, 1), tag});
      if (!is_dirichlet(tag)) continue;
      for (const int v : body_.edges.row(e)) side_[v] = tag;
    }
  }

  /// Whether Sigma ends at its vertex v.
  bool is_end(int v) const { return degree_[v] == 1; }
  /// The vertex `row` rows below vertex v of Sigma.
  int vertex(int v, int row) const { return row == 0 ? v : below_[v] + row - 1; }

  const TriangleMesh& body_;
  int rows_;
  std::vector<int> below_;     ///< per vertex of Sigma: the first vertex below it
  std::vector<int> degree_;    ///< per vertex: how many edges of Sigma it has
  std::vector<EdgeTag> side_;  ///< per vertex: the condition on the side of the layer below it
  std::vector<Eigen::RowVector2d> vertices_;
  std::vector<Eigen::RowVector3i> triangles_;
  std::vector<TaggedEdge> tagged_;
};

}  // namespace

TriangleMesh extruded(const TriangleMesh& body, double epsilon, bool along_normals) {
  check_body(body, epsilon, along_normals);
  const SigmaEdges edges = sigma_edges(body, along_normals);
  Eigen::VectorXd curvature;
  if (along_normals) curvature = curvatures(body, edges, epsilon);
  const int rows = row_count(body, edges, epsilon);
  Extrusion extrusion(body, edges, rows);
  extrusion.add_vertices(edges, along_normals);
  std::vector<CurvedColumn> columns(along_normals ? body.triangle_count() : 0);  // per triangle
  for (const auto& [left, right] : edges) {
    if (along_normals)
      columns.insert(columns.end(), 2 * rows, extrusion.curved_column(left, right, curvature));
    extrusion.add_column(left, right);
  }
  TriangleMesh mesh = extrusion.mesh();
  mesh.geometry = body.geometry;
  mesh.curved_columns = std::move(columns);
  return mesh;
}

Points drawn_along_normals(const TriangleMesh& mesh) {
  Points points = mesh.vertices;
  Points normal = Points::Zero(mesh.vertex_count(), 2);
  Eigen::VectorXd depth = Eigen::VectorXd::Zero(mesh.vertex_count());
  double thickness = (points.col(0).maxCoeff() - points.col(0).minCoeff()) / 10;
  for (std::size_t t = 0; t < mesh.curved_columns.size(); ++t) {
    if (mesh.region[t] != Region::layer) continue;
    const CurvedColumn& column = mesh.curved_columns[t];
    if (column.curvature < 0) thickness = std::min(thickness, -0.5 / column.curvature);
    for (const int v : mesh.triangles.row(static_cast<Eigen::Index>(t))) {
      depth(v) = column.intercept + column.slope * points(v, 0) - points(v, 1);
      normal.row(v) += Eigen::RowVector2d(column.slope, -1).normalized();
    }
  }
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (depth(v) > 0)
      points.row(v) +=
          depth(v) * (Eigen::RowVector2d(0, 1) + thickness * normal.row(v).normalized());
  return points;
}

TriangleMesh layered_mesh(int cells, double epsilon) {
  return extruded(unstructured_mesh(cells, Domain{.layer_depth = 0}), epsilon);
}

}  // namespace antilock
