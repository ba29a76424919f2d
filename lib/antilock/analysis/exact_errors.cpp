#include "antilock/analysis/exact_errors.hpp"

#include <cmath>

#include "antilock/form/quadrature.hpp"

namespace antilock {

ExactErrors exact_errors(const TriangleMesh& mesh, const EquilibratedFlux& flux, const Companion& v,
                         const TruthTable& truth) {
  const Quadrature& rule = triangle_rule(8);
  double cr = 0, balanced = 0, conforming = 0, middle = 0;
  const auto exact = [&](const Eigen::Vector2d& x, bool layer) {
    const TruthPoint found = truth.at(x(0), x(1));
    return layer ? Eigen::Vector2d(found.gradient(0), found.layer_stress) : found.gradient;
  };
  int row = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const bool layer = mesh.region[t] == Region::layer;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    for (int i = 0; i < 3; ++i)
      gradient += v.at_vertices(mesh.triangles(t, i)) * barycentric_gradients(mesh, t).row(i).transpose();
    if (layer && !v.layer) gradient(1) = v.stress(row);
    row += layer ? 1 : 0;
    const Eigen::MatrixX2d tau = flux.tau(mesh, t, rule.points);
    const LayerLaw body = [&] {
      LayerLaw law = flux.law;
      if (!layer) law.x = law.y = 1;
      return law;
    }();
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const double w = mesh.area(t) * rule.weights(q);
      const Eigen::Vector2d u = exact(point_in(mesh, t, rule.points.row(q)), layer), s = flux.cell[t].s;
      const Eigen::Vector2d sigma = layer ? s : Eigen::Vector2d(s + tau.row(q).transpose());
      cr += w * body.squared(u - s);
      balanced += w * body.squared(u - sigma);
      if (layer && v.layer) continue;
      conforming += w * body.squared(u - gradient);
      middle += w * body.squared(u - (sigma + gradient) / 2);
    }
  }
  if (v.layer) {
    const TriangleMesh& columns = v.layer->mesh();
    for (int t = v.layer->first_triangle(); t < columns.triangle_count(); ++t)
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
        const Eigen::Vector2d u = exact(point_in(columns, t, rule.points.row(q)), true);
        conforming +=
            columns.area(t) * rule.weights(q) * flux.law.squared(u - v.layer->flux_of(t - v.layer->first_triangle()));
      }
  }
  return {std::sqrt(cr), std::sqrt(balanced), std::sqrt(conforming), v.layer ? 0 : std::sqrt(middle)};
}

}  // namespace antilock
