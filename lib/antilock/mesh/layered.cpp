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

/// The edges of Sigma, each from left to right.
std::vector<std::array<int, 2>> sigma_edges(const TriangleMesh& mesh, bool along_normals) {
  const double off = on_line * body_size(mesh);
  std::vector<std::array<int, 2>> edges;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    std::array<int, 2> ends{mesh.edges(e, 0), mesh.edges(e, 1)};
    if (mesh.vertices(ends[0], 0) > mesh.vertices(ends[1], 0)) std::swap(ends[0], ends[1]);
    for (const int v : ends)
      if (!along_normals && std::abs(mesh.vertices(v, 1)) > off)
        throw Error("extruded layer: Sigma has a vertex at " + mesh.location_text(v) +
                    "; accepted: Sigma on the line y = 0");
    const auto corners = mesh.triangles.row(mesh.edge_triangles(e, 0));
    const Eigen::RowVector2d from = mesh.vertices.row(ends[0]), along = mesh.vertices.row(ends[1]) - from,
                             up = mesh.vertices(corners, Eigen::all).colwise().mean() - from;
    if (along_normals && along(0) * up(1) <= along(1) * up(0))
      throw Error("extruded layer: the body is not above its contact edge at " + mesh.location_text(ends[0]) +
                  "; accepted: edges with the body above them");
    edges.push_back(ends);
  }
  if (edges.empty()) throw MeshError("extruded layer: the body has no edge in the group contact to stand on");
  return edges;
}

/// The curvature at the vertices of Sigma where two of its edges meet; 0 elsewhere. Throws what extruded() says.
Eigen::VectorXd curvatures(const TriangleMesh& mesh, std::vector<std::array<int, 2>> edges, double thickness) {
  const double off = on_line * body_size(mesh);
  const auto x = [&](int v) { return mesh.vertices(v, 0); };
  std::sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) { return x(a[0]) < x(b[0]); });
  Eigen::VectorXd turn = Eigen::VectorXd::Zero(mesh.vertex_count()), length = turn, count = turn;
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
          fmt::format("extruded layer: the layer, {:g} thick, meets itself at {}, where Sigma is a hollow of radius "
                      "{:.3g}; accepted: a thickness below that",
                      thickness, mesh.location_text(v), -1 / turn(v)));
  }
  return turn;
}

}  // namespace

TriangleMesh extruded(const TriangleMesh& body, double epsilon, bool along_normals) {
  if (!(epsilon >= 0 && epsilon <= 1))
    throw Error(fmt::format("extruded layer: epsilon = {} is out of range; accepted 0 <= epsilon <= 1", epsilon));
  if (std::find(body.region.begin(), body.region.end(), Region::layer) != body.region.end())
    throw Error("extruded layer: the mesh has a layer; accepted: a body alone");
  const double off = on_line * body_size(body);
  std::vector<Eigen::RowVector2d> vertices;
  for (int v = 0; v < body.vertex_count(); ++v) {
    if (!along_normals && body.vertices(v, 1) < -off)
      throw Error("extruded layer: the body has a vertex at " + body.location_text(v) +
                  "; accepted: a body above y = 0");
    vertices.emplace_back(body.vertices.row(v));
  }
  const auto columns = sigma_edges(body, along_normals);
  const Eigen::VectorXd curvature = along_normals ? curvatures(body, columns, epsilon) : Eigen::VectorXd();
  double length = 0;
  for (const auto& [left, right] : columns) length += (body.vertices.row(right) - body.vertices.row(left)).norm();
  const double cells = epsilon * static_cast<double>(columns.size()) / length;  // epsilon / h
  const int rows = std::max(1, static_cast<int>(std::ceil(cells - 1e-9)));

  // below[v] + j: the vertex j + 1 rows below vertex v of Sigma; degree 1: an end of Sigma
  std::vector<int> below(body.vertex_count(), -1), degree(body.vertex_count(), 0);
  for (const auto& ends : columns)
    for (const int v : ends)
      if (++degree[v] == 1) {
        below[v] = static_cast<int>(vertices.size());
        for (int j = 1; j <= rows; ++j)
          vertices.emplace_back(body.vertices(v, 0),
                                (along_normals ? body.vertices(v, 1) : 0) - static_cast<double>(j) / rows);
      }
  const auto vertex = [&](int v, int row) { return row == 0 ? v : below[v] + row - 1; };

  std::vector<Eigen::RowVector3i> triangles(body.triangles.rowwise().begin(), body.triangles.rowwise().end());
  std::vector<Region> region(triangles.size(), Region::body);
  std::vector<TaggedEdge> tagged;
  // where the body is held beside Sigma, so is the layer
  std::vector<EdgeTag> side(body.vertex_count(), EdgeTag::free);
  for (int e = 0; e < body.edge_count(); ++e) {
    const int from = body.edges(e, 0), to = body.edges(e, 1);
    const EdgeTag tag = body.edge_tag[e];
    if (tag == EdgeTag::interior || tag == EdgeTag::contact) continue;
    tagged.push_back({from, to, tag});
    if (is_dirichlet(tag)) side[from] = side[to] = tag;
  }
  std::vector<CurvedColumn> column(along_normals ? triangles.size() : 0);
  for (const auto& [left, right] : columns) {
    if (along_normals) {
      const Eigen::RowVector2d along = body.vertices.row(right) - body.vertices.row(left);
      const double slope = along(1) / along(0), ends = (degree[left] == 2 ? 1 : 0) + (degree[right] == 2 ? 1 : 0);
      column.insert(column.end(), 2 * rows,
                    {body.vertices(left, 1) - slope * body.vertices(left, 0), slope,
                     (curvature(left) + curvature(right)) / std::max(ends, 1.0)});
      for (const int v : {left, right})
        if (degree[v] == 1 && side[v].kind == EdgeTag::Kind::dirichlet)
          throw Error("extruded layer: a displacement is given at " + body.location_text(v) +
                      ", where a curved Sigma ends; accepted: clamped or free there");
    }
    for (int j = 0; j < rows; ++j) {
      triangles.emplace_back(vertex(left, j + 1), vertex(right, j + 1), vertex(right, j));
      triangles.emplace_back(vertex(left, j + 1), vertex(right, j), vertex(left, j));
      for (const int v : {left, right})
        if (degree[v] == 1) tagged.push_back({vertex(v, j), vertex(v, j + 1), side[v]});
    }
    tagged.push_back({vertex(left, 0), vertex(right, 0), EdgeTag::sigma});
    tagged.push_back({vertex(left, rows), vertex(right, rows), EdgeTag::contact});
  }
  region.resize(triangles.size(), Region::layer);

  TriangleMesh mesh =
      make_triangle_mesh(Eigen::Map<Points>(vertices[0].data(), static_cast<Eigen::Index>(vertices.size()), 2),
                         Eigen::Map<Triples>(triangles[0].data(), static_cast<Eigen::Index>(triangles.size()), 3),
                         region, tagged, "extruded layer");
  mesh.geometry = body.geometry;
  mesh.curved_columns = std::move(column);
  return mesh;
}

Points drawn_along_normals(const TriangleMesh& mesh) {
  Points points = mesh.vertices, normal = Points::Zero(mesh.vertex_count(), 2);
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
    if (depth(v) > 0) points.row(v) += depth(v) * (Eigen::RowVector2d(0, 1) + thickness * normal.row(v).normalized());
  return points;
}

TriangleMesh layered_mesh(int cells, double epsilon) {
  return extruded(unstructured_mesh(cells, Domain{.layer_depth = 0}), epsilon);
}

}  // namespace antilock
