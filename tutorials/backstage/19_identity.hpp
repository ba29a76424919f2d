#pragma once
#include "antilock/form/quadrature.hpp"
#include "backstage/19_certified.hpp"

namespace antilock::tutorial {

/// What stands in the identity beside the two errors: the works of contact, int lambda_u v + int lambda_h u, and
/// -(f - f_1, u).
inline double works(const Space& cr, const EquilibratedFlux& flux, const Companion& v, const Exact& exact) {
  const TriangleMesh& mesh = cr.mesh();
  const auto [points, weights] = gauss_rule(4);
  double work = 0;
  for (std::size_t place = 0; place < cr.contact().size(); ++place) {
    const int edge = cr.contact()[place], from = mesh.edges(edge, 0),
              to = mesh.edges(edge, 1);  // an unknown is an edge
    for (Eigen::Index q = 0; q < points.size(); ++q) {
      const double s = points(q), x = (1 - s) * mesh.vertices(from, 0) + s * mesh.vertices(to, 0);
      const double v_there = v.layer ? v.layer->value({x, -1}) : (1 - s) * v.at_vertices(from) + s * v.at_vertices(to);
      work += weights(q) * mesh.edge_length(edge) * exact.truth.pressure(x) * v_there;
      work += weights(q) * flux.lambda(static_cast<Eigen::Index>(place)) * exact.table.value(x, -1);
    }
  }
  const Quadrature& rule = triangle_rule(8);
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (Eigen::Index q = 0; mesh.region[t] == Region::body && q < rule.weights.size(); ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
      const double rest = paper_load(x(0), x(1)) - rule.points.row(q).dot(flux.cell[t].f);  // f - f_1
      work -= mesh.area(t) * rule.weights(q) * rest * exact.table.value(x(0), x(1));
    }
  return work;
}

}  // namespace antilock::tutorial
