#include "antilock/mesh/refine.hpp"

namespace antilock {

TriangleMesh refined(const TriangleMesh& mesh) {
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
  Triples triangles(4 * mesh.triangle_count(), 3);
  std::vector<Region> region;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::RowVector3i v = mesh.triangles.row(t), m = mesh.triangle_edges.row(t).array() + corners;
    triangles.row(4 * t) << v(0), m(2), m(1);  // midpoint i lies opposite vertex i
    triangles.row(4 * t + 1) << v(1), m(0), m(2);
    triangles.row(4 * t + 2) << v(2), m(1), m(0);
    triangles.row(4 * t + 3) = m;
    region.insert(region.end(), 4, mesh.region[t]);
  }
  return make_triangle_mesh(std::move(vertices), std::move(triangles), std::move(region), tagged, "refined mesh");
}

}  // namespace antilock
