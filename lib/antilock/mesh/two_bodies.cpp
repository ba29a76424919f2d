#include "antilock/mesh/two_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

/// The y of the contact edges.
double contact_height(const TriangleMesh& mesh) {
  std::optional<double> height;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    for (const int v : mesh.edges.row(e)) {
      const double y = mesh.vertices(v, 1);
      if (!height) height = y;
      if (std::abs(y - *height) > 1e-12 * body_size(mesh))
        throw Error(fmt::format(
            "two bodies: the contact edge at {} is off y = {:.6g}; accepted: all on one line",
            mesh.location_text(v), *height));
    }
  }
  if (!height) throw Error("two bodies: a mesh has no contact edge; accepted: one or more");
  return *height;
}

void check_joinable(const TriangleMesh& mesh) {
  require_triangles(mesh, "two bodies");
  const bool has_group = std::any_of(mesh.edge_tag.begin(), mesh.edge_tag.end(),
                                     [](EdgeTag tag) { return tag.group >= 0; });
  if (has_group || mesh.curved() || !mesh.geometry.file.empty())
    throw Error(
        "two bodies: a mesh has named groups, a curved layer or a geometry; accepted: none of "
        "them");
}

/// `mesh` below the line y = height, upside down.
TriangleMesh reflected_below(TriangleMesh mesh, double height) {
  const double own = contact_height(mesh);
  mesh.vertices.col(1) = (own + height - mesh.vertices.col(1).array()).matrix();
  // counterclockwise again; edge i stays opposite vertex i
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  mesh.triangle_edges.col(1).swap(mesh.triangle_edges.col(2));
  return mesh;
}

void rename_contact(TriangleMesh& mesh, EdgeTag side) {
  std::replace(mesh.edge_tag.begin(), mesh.edge_tag.end(), EdgeTag::contact, side);
}

/// `a` with the rows of `b` behind it.
template <class Rows>
Rows stacked(const Rows& a, const Rows& b) {
  Rows both(a.rows() + b.rows(), a.cols());
  both << a, b;
  return both;
}

}  // namespace

TriangleMesh two_body_mesh(const TriangleMesh& upper, const TriangleMesh& lower) {
  check_joinable(upper);
  check_joinable(lower);
  TriangleMesh mesh = upper;
  TriangleMesh below = reflected_below(lower, contact_height(upper));
  rename_contact(mesh, upper_side);
  rename_contact(below, lower_side);
  below.triangles.array() += upper.vertex_count();
  below.edges.array() += upper.vertex_count();
  below.triangle_edges.array() += upper.edge_count();
  for (int& t : below.edge_triangles.reshaped())
    if (t >= 0) t += upper.triangle_count();
  mesh.vertices = stacked(mesh.vertices, below.vertices);
  mesh.triangles = stacked(mesh.triangles, below.triangles);
  mesh.edges = stacked(mesh.edges, below.edges);
  mesh.triangle_edges = stacked(mesh.triangle_edges, below.triangle_edges);
  mesh.edge_triangles = stacked(mesh.edge_triangles, below.edge_triangles);
  mesh.region.insert(mesh.region.end(), below.region.begin(), below.region.end());
  mesh.edge_tag.insert(mesh.edge_tag.end(), below.edge_tag.begin(), below.edge_tag.end());
  return mesh;
}

}  // namespace antilock
