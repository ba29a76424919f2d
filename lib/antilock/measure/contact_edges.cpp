#include "antilock/measure/contact_edges.hpp"

#include <algorithm>

#include "antilock/mesh/quadrature.hpp"

namespace antilock {

std::vector<ContactEdge> contact_edges(const TriangleMesh& mesh) {
  require_triangles(mesh, "contact edges");
  std::vector<ContactEdge> edges;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    const int t = mesh.edge_triangles(e, 0);
    edges.push_back({t, local_edge(mesh, t, e), mesh.edge_length(e)});
  }
  return edges;
}

Eigen::MatrixX3d contact_trace(const Space& space, const Eigen::VectorXd& v) {
  constexpr int points = 32;
  std::vector<Eigen::RowVector3d> samples;
  for (const ContactEdge& edge : contact_edges(space.mesh()))
    for (int k = 0; k < points; ++k) {
      const Eigen::Vector3d lambda = on_edge(edge.opposite, (k + 0.5) / points);
      const double value =
          space.element().basis(lambda).dot(v(space.cell_dofs().row(edge.triangle)));
      samples.emplace_back(point_in(space.mesh(), edge.triangle, lambda)(0), value,
                           edge.length / points);
    }
  std::sort(samples.begin(), samples.end(),
            [](const auto& a, const auto& b) { return a(0) < b(0); });
  Eigen::MatrixX3d trace(samples.size(), 3);
  for (std::size_t k = 0; k < samples.size(); ++k)
    trace.row(static_cast<Eigen::Index>(k)) = samples[k];
  return trace;
}

}  // namespace antilock
