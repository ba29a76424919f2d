#include "antilock/measure/errors.hpp"

#include <algorithm>
#include <cmath>

#include "antilock/exact/truth_table.hpp"
#include "antilock/form/quadrature.hpp"

namespace antilock {
namespace {

/// The lattice of order 4: corners, edge midpoints and quarters, three inner points.
const std::vector<Eigen::Vector3d>& sample_points() {
  static const std::vector<Eigen::Vector3d> points = [] {
    std::vector<Eigen::Vector3d> p;
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; i + j <= 4; ++j) p.emplace_back(i / 4.0, j / 4.0, (4 - i - j) / 4.0);
    return p;
  }();
  return points;
}

/// p_h on a layer triangle from its rows of B: constant (degree 1), affine through the edge midpoints (degree 2).
double layer_stress_at(const Eigen::VectorXd& p, Eigen::Index first_row, int degree, const Eigen::RowVector3d& lambda) {
  if (degree == 1) return p(first_row);
  return p.segment<3>(first_row).dot((1 - 2 * lambda.array()).matrix().transpose());
}

}  // namespace

Reference reference(const TruthTable& table) {
  return {[&table](double x, double y) { return table.value(x, y); },
          [&table](double x, double y) { return table.gradient(x, y); },
          [&table](double x, double y) { return table.layer_stress(x, y); }};
}

Errors measure_errors(const Space& space, const Solution& solution, double epsilon, const Reference& reference) {
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  const Quadrature& rule = radon_rule();
  const Eigen::Index points = rule.weights.size();
  std::vector<Eigen::VectorXd> basis, sample_basis;
  std::vector<Eigen::MatrixX3d> derivative;
  for (Eigen::Index q = 0; q < points; ++q) {
    basis.push_back(element.basis(rule.points.row(q)));
    derivative.push_back(element.derivative(rule.points.row(q)));
  }
  for (const Eigen::Vector3d& lambda : sample_points()) sample_basis.push_back(element.basis(lambda));

  Errors errors;
  for (int i = 0; i < space.size(); ++i)
    errors.max_at_unknowns = std::max(
        errors.max_at_unknowns, std::abs(solution.u(i) - reference.value(space.points()(i, 0), space.points()(i, 1))));
  double l2 = 0, gradient2 = 0, energy2 = 0;
  Eigen::Index row = 0;
  const int rows_a_triangle = element.degree() == 1 ? 1 : 3;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::VectorXd u = solution.u(space.unknowns().row(t));
    for (std::size_t k = 0; k < sample_basis.size(); ++k) {
      const Eigen::Vector2d x = point_in(mesh, t, sample_points()[k]);
      errors.max = std::max(errors.max, std::abs(u.dot(sample_basis[k]) - reference.value(x(0), x(1))));
    }
    const Eigen::Matrix<double, 3, 2> lambda = barycentric_gradients(mesh, t);
    const bool in_layer = mesh.region[t] == Region::layer;
    for (Eigen::Index q = 0; q < points; ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
      const double weight = rule.weights(q) * mesh.area(t);
      const double e = u.dot(basis[q]) - reference.value(x(0), x(1));
      const Eigen::Vector2d de = (derivative[q] * lambda).transpose() * u - reference.gradient(x(0), x(1));
      l2 += weight * e * e;
      gradient2 += weight * de.squaredNorm();
      if (in_layer && solution.p.size() > 0) {
        // epsilon^-2 (d/dy e)^2 = epsilon^2 (p_h - p)^2, which also holds at epsilon = 0
        const double dp =
            layer_stress_at(solution.p, row, element.degree(), rule.points.row(q)) - reference.layer_stress(x(0), x(1));
        energy2 += weight * (de(0) * de(0) + epsilon * epsilon * dp * dp);
      } else {
        energy2 += weight * de.squaredNorm();
      }
    }
    if (in_layer) row += rows_a_triangle;
  }
  errors.l2 = std::sqrt(l2);
  errors.h1 = std::sqrt(l2 + gradient2);
  errors.energy = std::sqrt(energy2);
  return errors;
}

std::vector<double> rates(const std::vector<double>& h, const std::vector<double>& errors) {
  std::vector<double> orders;
  for (std::size_t i = 1; i < h.size() && i < errors.size(); ++i)
    orders.push_back(std::log(errors[i - 1] / errors[i]) / std::log(h[i - 1] / h[i]));
  return orders;
}

double slope(const std::vector<double>& h, const std::vector<double>& errors) {
  const Eigen::ArrayXd x = Eigen::Map<const Eigen::ArrayXd>(h.data(), static_cast<Eigen::Index>(h.size())).log();
  const Eigen::ArrayXd y =
      Eigen::Map<const Eigen::ArrayXd>(errors.data(), static_cast<Eigen::Index>(errors.size())).log();
  const Eigen::ArrayXd dx = x - x.mean();
  return (dx * (y - y.mean())).sum() / dx.square().sum();
}

double energy(const VariationalInequality& problem, const Solution& solution) {
  const double stiff =
      problem.b.rows() > 0 ? problem.compliance * solution.p.dot(problem.m.cwiseProduct(solution.p)) : 0;
  return 0.5 * (solution.u.dot(problem.a1 * solution.u) + stiff) - problem.load.dot(solution.u);
}

}  // namespace antilock
