#include "antilock/certificate/exact_errors.hpp"

#include <cmath>

#include "antilock/mesh/quadrature.hpp"

namespace antilock {

ExactErrors exact_errors(const TriangleMesh& mesh, const EquilibratedFlux& flux,
                         const ConformingCompanion& v, const ExactTable& exact_solution) {
  require_triangles(mesh, "errors of a certificate");
  const Quadrature& rule = triangle_rule(8);
  double cr = 0, balanced = 0, conforming = 0, middle = 0;
  const auto exact = [&](const Eigen::Vector2d& x, bool layer) {
    const ExactPoint found = exact_solution.at(x(0), x(1));
    return layer ? Eigen::Vector2d(found.gradient(0), found.layer_stress) : found.gradient;
  };
  int row = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const bool layer = mesh.region[t] == Region::layer, columns = layer && v.layer;
    const auto& [law, s, f, traction, oscillation2, tau2] = flux.cell[t];
    const Eigen::Vector2d gradient = columns ? s : v.flux(mesh, t, row, law);
    row += layer ? 1 : 0;
    const Eigen::MatrixX2d tau = flux.tau(mesh, t, rule.points);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const double w = mesh.area(t) * rule.weights(q);
      const Eigen::Vector2d u = exact(point_in(mesh, t, rule.points.row(q)), layer),
                            sigma = s + tau.row(q).transpose();
      cr += w * law.squared(u - s);
      balanced += w * law.squared(u - sigma);
      if (columns) continue;
      conforming += w * law.squared(u - gradient);
      middle += w * law.squared(u - (sigma + gradient) / 2);
    }
  }
  if (v.layer) {
    const TriangleMesh& columns = v.layer->mesh();
    for (int t = v.layer->first_triangle(); t < columns.triangle_count(); ++t)
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
        const Eigen::Vector2d u = exact(point_in(columns, t, rule.points.row(q)), true);
        conforming += columns.area(t) * rule.weights(q) *
                      flux.law.squared(u - v.layer->flux_of(t - v.layer->first_triangle()));
      }
  }
  return {std::sqrt(cr), std::sqrt(balanced), std::sqrt(conforming),
          v.layer ? 0 : std::sqrt(middle)};
}

}  // namespace antilock
