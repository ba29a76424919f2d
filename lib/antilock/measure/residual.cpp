#include "antilock/measure/residual.hpp"

#include <algorithm>
#include <cmath>

#include "antilock/form/gradient_forms.hpp"
#include "antilock/measure/contact_edges.hpp"

namespace antilock {
namespace {

/// The rule on each of the four triangles that the edge midpoints cut.
Quadrature refined(const Quadrature& rule) {
  const Eigen::Index n = rule.weights.size();
  const Eigen::MatrixX3d points = rule.points;
  Quadrature fine{ReferencePoints(4 * n, 3), Eigen::VectorXd(4 * n)};
  for (int part = 0; part < 4; ++part) {
    Eigen::Matrix3d corners =
        0.5 * (Eigen::Matrix3d::Ones() - Eigen::Matrix3d::Identity());  // the one in the middle
    if (part < 3)
      corners = 0.5 * Eigen::Matrix3d::Identity() +
                0.5 * Eigen::Vector3d::Ones() * Eigen::RowVector3d::Unit(part);
    fine.points.middleRows(part * n, n) = points * corners;
    fine.weights.segment(part * n, n) = rule.weights / 4;
  }
  return fine;
}

/// Adds int w phi_i + q . grad phi_i to each sum(i), where `known` holds w as the value and q as
/// the gradient.
void add_products(const Space& space, int t, const Quadrature& rule,
                  const std::function<ExactPoint(const Eigen::Vector2d&)>& known,
                  Eigen::VectorXd& sum) {
  const TriangleMesh& mesh = space.mesh();
  const Eigen::Matrix<double, 3, 2> lambda = barycentric_gradients(mesh, t);
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const ExactPoint here = known(point_in(mesh, t, rule.points.row(q)));
    const Eigen::MatrixX3d derivative = space.element().derivative(rule.points.row(q));
    const Eigen::VectorXd product = space.element().basis(rule.points.row(q)) * here.value +
                                    derivative * (lambda * here.gradient);
    sum(space.cell_dofs().row(t)) += rule.weights(q) * mesh.area(t) * product;
  }
}

/// Whether one of the lines x = breaks[k] meets the triangle.
bool across(const TriangleMesh& mesh, int t, const std::vector<double>& breaks) {
  double low = 1, high = 0;
  for (int i = 0; i < 3; ++i) {
    low = std::min(low, mesh.vertices(mesh.triangles(t, i), 0));
    high = std::max(high, mesh.vertices(mesh.triangles(t, i), 0));
  }
  return std::any_of(breaks.begin(), breaks.end(), [&](double x) { return low < x && x < high; });
}

}  // namespace

Eigen::VectorXd consistency_residual(const Space& space, const Eigen::VectorXd& load,
                                     const Reference& exact, const std::vector<double>& breaks) {
  require_triangles(space.mesh(), "residual of an exact solution");
  static const Quadrature fine = refined(refined(refined(refined(radon_rule()))));
  const TriangleMesh& mesh = space.mesh();
  Eigen::VectorXd residual = -load;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const bool in_layer = mesh.region[t] == Region::layer;
    const auto flux = [&](const Eigen::Vector2d& x) {
      ExactPoint known = exact.known(x, in_layer);
      known.value = 0;
      if (in_layer) known.gradient(1) = known.layer_stress;
      return known;
    };
    add_products(space, t, in_layer && across(mesh, t, breaks) ? fine : load_rule(space.element()),
                 flux, residual);
  }
  return residual;
}

Eigen::VectorXd h1_products(const Space& space, const Reference& exact) {
  require_triangles(space.mesh(), "products with an exact solution");
  Eigen::VectorXd products = Eigen::VectorXd::Zero(space.size());
  const auto known = [&](const Eigen::Vector2d& x) { return exact.known(x, false); };
  for (int t = 0; t < space.mesh().triangle_count(); ++t)
    add_products(space, t, load_rule(space.element()), known, products);
  return products;
}

Eigen::VectorXd contact_work(const Space& space, const Profile& g) {
  constexpr int points = 32;
  const TriangleMesh& mesh = space.mesh();
  Eigen::VectorXd work = Eigen::VectorXd::Zero(space.size());
  for (const ContactEdge& edge : contact_edges(mesh))
    for (int k = 0; k < points; ++k) {
      const Eigen::Vector3d lambda = on_edge(edge.opposite, (k + 0.5) / points);
      const double weighted = edge.length / points * g(point_in(mesh, edge.triangle, lambda)(0));
      work(space.cell_dofs().row(edge.triangle)) += weighted * space.element().basis(lambda);
    }
  return work;
}

Eigen::VectorXd interpolant(const Space& space, const Field& u) {
  if (space.element().name() != crouzeix_raviart().name()) return dof_values(space, u);
  require_triangles(space.mesh(), "means over edges");
  Eigen::VectorXd values(space.size());
  const TriangleMesh& mesh = space.mesh();  // the unknowns of Crouzeix-Raviart are the edges
  const double s = 0.5 * std::sqrt(0.6);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const Eigen::RowVector2d a = mesh.vertices.row(mesh.edges(e, 0)),
                             b = mesh.vertices.row(mesh.edges(e, 1));
    const auto at = [&](double r) { return u(a(0) + r * (b(0) - a(0)), a(1) + r * (b(1) - a(1))); };
    values(e) = (5 * at(0.5 - s) + 8 * at(0.5) + 5 * at(0.5 + s)) / 18;
  }
  return values;
}

}  // namespace antilock
