#include "antilock/mesh/submesh.hpp"

#include <algorithm>

namespace antilock {

Submesh submesh(const TriangleMesh& mesh, const std::function<bool(int triangle)>& selected) {
  const int corners = mesh.reference().vertices;
  Submesh part;
  std::vector<int> number(mesh.vertex_count(), -1), owners(mesh.edge_count(), 0);
  std::vector<Region> region;
  IndexRows triangles(mesh.triangle_count(), corners);
  int count = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (!selected(t)) continue;
    for (int i = 0; i < mesh.reference().facets; ++i) ++owners[mesh.triangle_edges(t, i)];
    for (int i = 0; i < corners; ++i) {
      const int v = mesh.triangles(t, i);
      if (number[v] < 0) {
        number[v] = static_cast<int>(part.old_vertex.size());
        part.old_vertex.push_back(v);
      }
      triangles(count, i) = number[v];
    }
    region.push_back(mesh.region[t]);
    ++count;
  }
  triangles.conservativeResize(count, corners);
  std::vector<TaggedEdge> tagged;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (owners[e] == 0) continue;
    EdgeTag tag = mesh.edge_tag[e];
    if (owners[e] == 1 && tag == EdgeTag::interior) tag = EdgeTag::clamped;
    if (owners[e] == 1 && tag == EdgeTag::sigma) tag = EdgeTag::contact;
    if (tag == EdgeTag::interior) continue;
    tagged.emplace_back(number[mesh.edges(e, 0)], number[mesh.edges(e, 1)], tag);
    if (mesh.dimension() == 3) tagged.back().vertices[2] = number[mesh.edges(e, 2)];
  }
  Points points = mesh.vertices(part.old_vertex, Eigen::indexing::all);
  part.mesh = make_mesh(std::move(points), std::move(triangles), std::move(region), tagged,
                        "a part of a mesh");
  part.mesh.geometry = mesh.geometry;
  return part;
}

TriangleMesh body_submesh(const TriangleMesh& mesh) {
  if (std::find(mesh.region.begin(), mesh.region.end(), Region::layer) == mesh.region.end())
    return mesh;
  return submesh(mesh, [&](int t) { return mesh.region[t] == Region::body; }).mesh;
}

}  // namespace antilock
