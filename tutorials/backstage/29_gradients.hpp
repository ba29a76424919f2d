#pragma once
#include "antilock/form/quadrature.hpp"
#include "antilock/problem/bounds.hpp"
#include "backstage/29_pressure.hpp"

namespace antilock::tutorial {

/// Loads grad psi of norm 1 that are orthogonal, psi ~ sin(k pi x) sin((m - 1/2) pi y), k, m = 1 ... waves: one column per
/// load. `on_fluxes`: the test function is replaced by the Raviart-Thomas field with its fluxes.
inline Eigen::MatrixXd gradient_loads(const Space& space, int waves, bool on_fluxes) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = triangle_rule(12);
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(2 * space.size(), waves * waves);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Matrix<double, 3, 2> normals =
        -barycentric_gradients(mesh, t);  // times 2 |T|: outward, as long as edges
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
      const Eigen::VectorXd phi = space.element().basis(rule.points.row(q));
      for (int j = 0; j < loads.cols(); ++j) {
        const int across = j / waves, along = j % waves;
        const double a = (across + 1) * std::numbers::pi, b = (along + 0.5) * std::numbers::pi;
        const Eigen::Vector2d f =
            mesh.area(t) * rule.weights(q) * 2 / std::hypot(a, b) *
            Eigen::Vector2d(a * std::cos(a * x(0)) * std::sin(b * x(1)), b * std::sin(a * x(0)) * std::cos(b * x(1)));
        for (int i = 0; i < phi.size(); ++i)
          for (const int c : {0, 1})
            loads(space.unknowns()(t, i) + c * space.size(), j) +=
                on_fluxes ? normals(i, c) * f.dot(x - mesh.vertices.row(mesh.triangles(t, i)).transpose())
                          : f(c) * phi(i);
      }
    }
  }
  return loads;
}

/// The inf-sup constant over all v_h, over those that are 0 on the contact set, and over those that are 0 on all of Gamma_C.
inline Table inf_sup_constants(const Mixed& way) {
  Table rows({"name", "h", "held", "beta"});
  for (const int n : {4, 8, 12, 16}) {
    const TriangleMesh mesh = block(n);
    const VariationalInequality problem = rubber(way, Space(mesh, way.element));
    const std::size_t bounds = problem.contact.size();
    for (const auto& [held, marks] : {std::pair{"nothing", std::vector<bool>(bounds)},
                                      {"contact set", active_set(problem).active},
                                      {"all of Gamma_C", std::vector<bool>(bounds, true)}}) {
      const VariationalInequality linear = held_in_contact(problem, marks);
      rows.add({way.name, 1.0 / n, held,
                inf_sup(multiplier_gram(linear, linear.a1), Eigen::MatrixXd(linear.m.asDiagonal()))});
    }
  }
  return rows;
}

}  // namespace antilock::tutorial
