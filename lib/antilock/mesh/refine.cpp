#include "antilock/mesh/refine.hpp"

#include <fmt/format.h>

#include <numeric>
#include <optional>

#include "antilock/core/error.hpp"
#include "antilock/mesh/detail/gmsh_session.hpp"

namespace antilock {

void follow_geometry(const TriangleMesh& mesh, const std::vector<int>& middle, Points& vertices) {
  require_triangles(mesh, "mesh on the curves of a geometry");
  if (mesh.geometry.empty()) return;
  constexpr double slack = 1e-6;  // of the mesh's size: mesh files have from 6 to 16 digits
  const double size =
      (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).maxCoeff();
  // a session per call: gmsh has one global model, which the next mesh needs
  GmshSession gmsh;
  const std::vector<int> curves = gmsh.read_curves(mesh.geometry);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const EdgeTag tag = mesh.edge_tag[e];
    if (middle[e] < 0 || mesh.edge_triangles(e, 1) >= 0 || tag == EdgeTag::contact ||
        mesh.region[mesh.edge_triangles(e, 0)] == Region::layer)
      continue;
    Eigen::Matrix3d asked = Eigen::Matrix3d::Zero(),
                    found;  // both ends and the middle, a column each
    asked.topLeftCorner<2, 1>() = mesh.vertices.row(mesh.edges(e, 0));
    asked.block<2, 1>(0, 1) = mesh.vertices.row(mesh.edges(e, 1));
    asked.col(2) = (asked.col(0) + asked.col(1)) / 2;
    std::optional<double> nearest;
    for (const int curve : curves) {
      const std::vector<double> points = gmsh.nearest(curve, {asked.data(), asked.data() + 9});
      found = Eigen::Map<const Eigen::Matrix3d>(points.data());
      const Eigen::RowVector3d away = (found - asked).colwise().norm();
      if (std::max(away(0), away(1)) > slack * size || (nearest && *nearest <= away(2))) continue;
      nearest = away(2);
      // a straight curve leaves the middle where it is, to the last digit
      if (away(2) > slack * (asked.col(1) - asked.col(0)).norm())
        vertices.row(middle[e]) = found.col(2).head<2>();
    }
    if (!nearest)
      throw Error(fmt::format(
          "{}: no curve of it holds the edge of the boundary from {} to {}; accepted: the geometry "
          "that the mesh was made from, or none",
          mesh.geometry.file, mesh.location_text(mesh.edges(e, 0)),
          mesh.location_text(mesh.edges(e, 1))));
  }
}

std::string refinement_name(const TriangleMesh& mesh, const std::string& how) {
  return mesh.geometry.empty() ? how
                               : how + " on the curves of " + mesh.geometry.file +
                                     ", for which the first mesh is too coarse";
}

TriangleMesh refined(const TriangleMesh& mesh) {
  require_triangles(mesh, "refined mesh");
  const int corners = mesh.vertex_count();  // the midpoint of edge e becomes vertex corners + e
  Points vertices(corners + mesh.edge_count(), 2);
  vertices.topRows(corners) = mesh.vertices;
  std::vector<TaggedEdge> tagged;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int from = mesh.edges(e, 0), to = mesh.edges(e, 1), middle = corners + e;
    vertices.row(middle) = 0.5 * (mesh.vertices.row(from) + mesh.vertices.row(to));
    if (mesh.edge_tag[e] == EdgeTag::interior) continue;
    tagged.push_back({from, middle, mesh.edge_tag[e]});
    tagged.push_back({middle, to, mesh.edge_tag[e]});
  }
  std::vector<int> middle(mesh.edge_count());
  std::iota(middle.begin(), middle.end(), corners);
  follow_geometry(mesh, middle, vertices);
  Triples triangles(4 * mesh.triangle_count(), 3);
  std::vector<Region> region;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::RowVector3i v = mesh.triangles.row(t).head<3>();
    const Eigen::RowVector3i m = mesh.triangle_edges.row(t).head<3>().array() + corners;
    triangles.row(4 * t) << v(0), m(2), m(1);  // midpoint i lies opposite vertex i
    triangles.row(4 * t + 1) << v(1), m(0), m(2);
    triangles.row(4 * t + 2) << v(2), m(1), m(0);
    triangles.row(4 * t + 3) << m(0), m(1), m(2);
    region.insert(region.end(), 4, mesh.region[t]);
  }
  TriangleMesh finer = make_mesh(std::move(vertices), std::move(triangles), std::move(region),
                                 tagged, refinement_name(mesh, "refined mesh"));
  finer.geometry = mesh.geometry;
  for (const CurvedColumn& column : mesh.curved_columns)
    finer.curved_columns.insert(finer.curved_columns.end(), 4, column);
  return finer;
}

}  // namespace antilock
