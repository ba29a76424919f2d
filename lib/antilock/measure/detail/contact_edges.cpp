#include "antilock/measure/detail/contact_edges.hpp"

namespace antilock {

Eigen::Vector3d ContactEdge::lambda(double s) const {
  Eigen::Vector3d l = Eigen::Vector3d::Zero();
  l((opposite + 1) % 3) = 1 - s;
  l((opposite + 2) % 3) = s;
  return l;
}

std::vector<ContactEdge> contact_edges(const TriangleMesh& mesh) {
  std::vector<ContactEdge> edges;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    const int t = mesh.edge_triangles(e, 0);
    int opposite = 0;
    while (mesh.triangle_edges(t, opposite) != e) ++opposite;
    edges.push_back({t, opposite, mesh.edge_length(e)});
  }
  return edges;
}

}  // namespace antilock
