// The third mesh: a body as gmsh likes it, a layer in columns, as Figure 3 has them.
#include "antilock/mesh/layered.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/mesh/generate.hpp"

namespace antilock {
namespace {

constexpr double on_line = 1e-9;  // of the body's size: gmsh places points of a line to about 1e-12

/// The facets of Sigma, d vertices each: in the plane from left to right, in space ascending.
using SigmaFacets = std::vector<std::array<int, 3>>;

/// Throws Error unless the body is above the edge of Sigma, which runs from left to right.
void check_body_above(const Mesh& mesh, int edge, int left, int right) {
  const auto corners = mesh.triangles.row(mesh.edge_triangles(edge, 0));
  const Eigen::RowVector2d from = mesh.vertices.row(left);
  const Eigen::RowVector2d along = mesh.vertices.row(right) - from;
  const Eigen::RowVector2d up =
      mesh.vertices(corners, Eigen::indexing::all).colwise().mean() - from;
  if (along(0) * up(1) <= along(1) * up(0))
    throw Error("extruded layer: the body is not above its contact edge at " +
                mesh.location_text(left) + "; accepted: edges with the body above them");
}

SigmaFacets sigma_facets(const Mesh& mesh, bool along_normals) {
  const double off = on_line * body_size(mesh);
  const int d = mesh.dimension();
  SigmaFacets facets;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    std::array<int, 3> corners{mesh.edges(e, 0), mesh.edges(e, 1), d == 3 ? mesh.edges(e, 2) : -1};
    if (d == 2 && mesh.vertices(corners[0], 0) > mesh.vertices(corners[1], 0))
      std::swap(corners[0], corners[1]);
    for (int k = 0; k < d; ++k)
      if (!along_normals && std::abs(mesh.vertices(corners[k], mesh.vertical())) > off)
        throw Error("extruded layer: Sigma has a vertex at " + mesh.location_text(corners[k]) +
                    "; accepted: Sigma on the " + (d == 2 ? "line y = 0" : "plane z = 0"));
    if (along_normals) check_body_above(mesh, e, corners[0], corners[1]);
    facets.push_back(corners);
  }
  if (facets.empty())
    throw MeshError(std::string("extruded layer: the body has no ") + (d == 2 ? "edge" : "face") +
                    " in the group contact to stand on");
  return facets;
}

/// The curvature at the vertices of Sigma where two of its edges meet; 0 elsewhere. Throws where
/// extruded() says so.
Eigen::VectorXd curvatures(const TriangleMesh& mesh, SigmaFacets edges, double thickness) {
  const double off = on_line * body_size(mesh);
  const auto x = [&](int v) { return mesh.vertices(v, 0); };
  std::sort(edges.begin(), edges.end(),
            [&](const auto& a, const auto& b) { return x(a[0]) < x(b[0]); });
  Eigen::VectorXd turn = Eigen::VectorXd::Zero(mesh.vertex_count());
  Eigen::VectorXd length = turn;
  Eigen::VectorXd count = turn;
  double end = edges.empty() ? 0 : x(edges[0][0]);
  for (const auto& [left, right, none] : edges) {
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

void check_body(const Mesh& body, double epsilon, bool along_normals) {
  if (along_normals) require_triangles(body, "extruded layer along normals");
  if (!body.reference().simplex)
    throw Error("extruded layer: a mesh of quadrilaterals; accepted: triangles and tetrahedra");
  if (!(epsilon >= 0 && epsilon <= 1))
    throw Error(fmt::format(
        "extruded layer: epsilon = {} is out of range; accepted 0 <= epsilon <= 1", epsilon));
  if (std::find(body.region.begin(), body.region.end(), Region::layer) != body.region.end())
    throw Error("extruded layer: the mesh has a layer; accepted: a body alone");
  const double off = on_line * body_size(body);
  for (int v = 0; v < body.vertex_count(); ++v)
    if (!along_normals && body.vertices(v, body.vertical()) < -off)
      throw Error("extruded layer: the body has a vertex at " + body.location_text(v) +
                  "; accepted: a body above " + (body.vertical() == 1 ? "y = 0" : "z = 0"));
}

/// As many rows as make cells of equal sides in a layer of thickness epsilon: h is the mean length
/// of the edges of Sigma, in space the side of a square of two faces of mean area.
int row_count(const Mesh& body, const SigmaFacets& facets, double epsilon) {
  const auto count = static_cast<double>(facets.size());
  double size = 0;
  for (const auto& [a, b, c] : facets) {
    const Position ab = body.vertices.row(b) - body.vertices.row(a);
    if (body.dimension() == 2) {
      size += ab.norm();
      continue;
    }
    const Position ac = body.vertices.row(c) - body.vertices.row(a);
    size += 0.5 * Eigen::Vector3d(ab.transpose()).cross(Eigen::Vector3d(ac.transpose())).norm();
  }
  double cells = epsilon * count / size;  // epsilon / h
  if (body.dimension() == 3) cells = epsilon * std::sqrt(count / (2 * size));
  return std::max(1, static_cast<int>(std::ceil(cells - 1e-9)));
}

/// The body and the columns below it, while they are made. A column below a facet with d vertices
/// is cut into d simplices per row, one below the other: simplex i has the upper vertices 0 to i
/// and the lower ones from i on. Neighbours in space number the vertices alike, in descending
/// order. So they cut the side between them alike.
class Extrusion {
  using Corners = std::array<int, 3>;
  /// The d - 1 vertices that two facets of Sigma share, ascending: a vertex and -1, or an edge.
  using Ridge = std::array<int, 2>;

 public:
  Extrusion(const Mesh& body, const SigmaFacets& facets, int rows)
      : body_(body),
        d_(body.dimension()),
        rows_(rows),
        below_(body.vertex_count(), -1),
        vertices_(body.vertices.data(), body.vertices.data() + body.vertices.size()),
        cells_(body.triangles.data(), body.triangles.data() + body.triangles.size()) {
    for (const Corners& facet : facets)
      for (int omitted = 0; omitted < d_; ++omitted) ++degree_[ridge(facet, omitted)];
    add_body_facets();
  }

  /// Adds the vertices below each vertex of Sigma. The layer begins at 0, or at the vertex.
  void add_vertices(const SigmaFacets& facets, bool along_normals) {
    for (const Corners& facet : facets)
      for (int k = 0; k < d_; ++k) {
        const int v = facet[k];
        if (below_[v] >= 0) continue;
        below_[v] = static_cast<int>(vertices_.size()) / d_;
        const double top = along_normals ? body_.vertices(v, d_ - 1) : 0;
        for (int j = 1; j <= rows_; ++j) {
          for (int axis = 0; axis + 1 < d_; ++axis) vertices_.push_back(body_.vertices(v, axis));
          vertices_.push_back(top - static_cast<double>(j) / rows_);
        }
      }
  }

  /// Adds the cells of the column below a facet, from Sigma down, and its facets on the boundary.
  void add_column(const Corners& facet) {
    Corners order = facet;
    std::reverse(order.begin(), order.begin() + d_);
    for (int j = 0; j < rows_; ++j)
      for (int i = 0; i < d_; ++i) add_cell(simplex(order, d_, j, i));
    for (int omitted = 0; omitted < d_; ++omitted) {
      const Ridge at = ridge(facet, omitted);
      if (!is_end(at)) continue;
      Corners side = order;
      std::copy(order.begin() + d_ - omitted, order.end(), side.begin() + d_ - 1 - omitted);
      add_side(side, side_tag(at));
    }
    Corners bottom = facet;
    for (int k = 0; k < d_; ++k) bottom[k] = vertex(facet[k], rows_);
    add_tagged(facet, EdgeTag::sigma);
    add_tagged(bottom, EdgeTag::contact);
  }

  /// The column below an edge of a curved Sigma. Throws where a displacement is given at its end.
  CurvedColumn curved_column(int left, int right, const Eigen::VectorXd& curvature) const {
    const Eigen::RowVector2d along = body_.vertices.row(right) - body_.vertices.row(left);
    const double slope = along(1) / along(0);
    // the mean of the curvatures at its ends, of those that have one
    const int inner_ends =
        static_cast<int>(!is_end({left, -1})) + static_cast<int>(!is_end({right, -1}));
    const double mean = (curvature(left) + curvature(right)) / std::max(inner_ends, 1);
    for (const int v : {left, right})
      if (is_end({v, -1}) && side_tag({v, -1}).kind == EdgeTag::Kind::dirichlet)
        throw Error("extruded layer: a displacement is given at " + body_.location_text(v) +
                    ", where a curved Sigma ends; accepted: clamped or free there");
    return {body_.vertices(left, 1) - slope * body_.vertices(left, 0), slope, mean};
  }

  Mesh mesh() const {
    const auto vertex_count = static_cast<Eigen::Index>(vertices_.size()) / d_;
    const auto cell_count = static_cast<Eigen::Index>(cells_.size()) / (d_ + 1);
    std::vector<Region> region(body_.triangle_count(), Region::body);
    region.resize(static_cast<std::size_t>(cell_count), Region::layer);
    return make_mesh(Eigen::Map<const Points>(vertices_.data(), vertex_count, d_),
                     Eigen::Map<const IndexRows>(cells_.data(), cell_count, d_ + 1), region,
                     tagged_, "extruded layer");
  }

 private:
  Ridge ridge(const Corners& facet, int omitted) const {
    Ridge shared{-1, -1};
    int next = 0;
    for (int k = 0; k < d_; ++k)
      if (k != omitted) shared[next++] = facet[k];
    if (d_ == 3 && shared[0] > shared[1]) std::swap(shared[0], shared[1]);
    return shared;
  }
  /// Whether Sigma ends at its ridge.
  bool is_end(const Ridge& at) const { return degree_.at(at) == 1; }
  /// The condition on the side of the layer below an end of Sigma.
  EdgeTag side_tag(const Ridge& at) const {
    const auto found = side_.find(at);
    return found == side_.end() ? EdgeTag::free : found->second;
  }
  /// The vertex `row` rows below vertex v of Sigma.
  int vertex(int v, int row) const { return row == 0 ? v : below_[v] + row - 1; }

  /// Simplex i of row j below the first `count` vertices of `top`: the lower vertices from the last
  /// one to i, then the upper ones from 0 to i.
  std::array<int, 4> simplex(const Corners& top, int count, int j, int i) const {
    std::array<int, 4> corners{-1, -1, -1, -1};
    int next = 0;
    for (int k = count - 1; k >= i; --k) corners[next++] = vertex(top[k], j + 1);
    for (int k = 0; k <= i; ++k) corners[next++] = vertex(top[k], j);
    return corners;
  }
  /// Adds a cell. In the plane the order of its vertices is counterclockwise.
  void add_cell(std::array<int, 4> corners) {
    if (d_ == 3) {
      Eigen::Matrix3d along;
      for (int i = 0; i < 3; ++i)
        for (int axis = 0; axis < 3; ++axis)
          along(i, axis) = vertices_[3 * corners[i + 1] + axis] - vertices_[3 * corners[0] + axis];
      if (along.determinant() < 0) std::swap(corners[2], corners[3]);
    }
    cells_.insert(cells_.end(), corners.begin(), corners.begin() + d_ + 1);
  }
  void add_tagged(const Corners& facet, EdgeTag tag) {
    if (d_ == 2)
      tagged_.emplace_back(facet[0], facet[1], tag);
    else
      tagged_.emplace_back(facet[0], facet[1], facet[2], tag);
  }
  /// Adds the facets of the side of the layer below a ridge.
  void add_side(const Corners& top, EdgeTag tag) {
    for (int j = 0; j < rows_; ++j)
      for (int i = 0; i + 1 < d_; ++i) {
        const std::array<int, 4> corners = simplex(top, d_ - 1, j, i);
        add_tagged({corners[0], corners[1], corners[2]}, tag);
      }
  }
  /// Takes over the facets of the body. Where the body is held beside Sigma, so is the layer.
  void add_body_facets() {
    for (int e = 0; e < body_.edge_count(); ++e) {
      const EdgeTag tag = body_.edge_tag[e];
      if (tag == EdgeTag::interior || tag == EdgeTag::contact) continue;
      const Corners facet{body_.edges(e, 0), body_.edges(e, 1), d_ == 3 ? body_.edges(e, 2) : -1};
      add_tagged(facet, tag);
      if (!is_dirichlet(tag)) continue;
      for (int omitted = 0; omitted < d_; ++omitted) side_[ridge(facet, omitted)] = tag;
    }
  }

  const Mesh& body_;
  int d_;
  int rows_;
  std::vector<int> below_;         ///< per vertex of Sigma: the first vertex below it
  std::map<Ridge, int> degree_;    ///< how many facets of Sigma meet there
  std::map<Ridge, EdgeTag> side_;  ///< the conditions of the body beside Sigma
  std::vector<double> vertices_;   ///< the coordinates, d per vertex
  std::vector<int> cells_;         ///< the vertices, d + 1 per cell
  std::vector<TaggedEdge> tagged_;
};

}  // namespace

TriangleMesh extruded(const TriangleMesh& body, double epsilon, bool along_normals) {
  check_body(body, epsilon, along_normals);
  const SigmaFacets facets = sigma_facets(body, along_normals);
  Eigen::VectorXd curvature;
  if (along_normals) curvature = curvatures(body, facets, epsilon);
  const int rows = row_count(body, facets, epsilon);
  Extrusion extrusion(body, facets, rows);
  extrusion.add_vertices(facets, along_normals);
  std::vector<CurvedColumn> columns(along_normals ? body.triangle_count() : 0);  // per triangle
  for (const auto& facet : facets) {
    if (along_normals)
      columns.insert(columns.end(), 2 * rows,
                     extrusion.curved_column(facet[0], facet[1], curvature));
    extrusion.add_column(facet);
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

TriangleMesh layered_mesh(int cells, double epsilon, CellKind kind) {
  return extruded(unstructured_mesh(cells, Domain{.layer_depth = 0, .kind = kind}), epsilon);
}

}  // namespace antilock
