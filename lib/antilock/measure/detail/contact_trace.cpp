#include "antilock/measure/detail/contact_trace.hpp"

#include <algorithm>

#include "antilock/measure/detail/contact_edges.hpp"

namespace antilock {

Eigen::MatrixX3d contact_trace(const Space& space, const Eigen::VectorXd& v, int points) {
  std::vector<Eigen::RowVector3d> samples;
  for (const ContactEdge& edge : contact_edges(space.mesh()))
    for (int k = 0; k < points; ++k) {
      const Eigen::Vector3d lambda = edge.lambda((k + 0.5) / points);
      const double value = space.element().basis(lambda).dot(v(space.unknowns().row(edge.triangle)));
      samples.emplace_back(point_in(space.mesh(), edge.triangle, lambda)(0), value, edge.length / points);
    }
  std::sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a(0) < b(0); });
  Eigen::MatrixX3d trace(samples.size(), 3);
  for (std::size_t k = 0; k < samples.size(); ++k) trace.row(static_cast<Eigen::Index>(k)) = samples[k];
  return trace;
}

}  // namespace antilock
