#include "antilock/measure/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/exact/exact_table.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/problem/bounds.hpp"

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

/// The monomials lambda_0^i lambda_1^j, i + j <= degree, at each point.
Eigen::MatrixXd monomials(const Eigen::MatrixX3d& points, int degree) {
  Eigen::MatrixXd values(points.rows(), (degree + 1) * (degree + 2) / 2);
  Eigen::Index column = 0;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j)
      values.col(column++) = points.col(0).array().pow(i) * points.col(1).array().pow(j);
  return values;
}

/// p_h on a layer triangle is of degree k - 1: its values at `points`, from its rows of B.
Eigen::MatrixXd layer_stress_values(const Element& element, const Eigen::MatrixX3d& points) {
  const int degree = element.degree() - 1;
  const Eigen::MatrixXd at_rows = monomials(strain_quadrature(element).points, degree);
  return monomials(points, degree) * pseudo_inverse(at_rows);
}

/// The larger of the two, and no number where one of them is none: std::max would pass over it.
double larger(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return a + b;
  return std::max(a, b);
}

/// u of the space, p of its layer.
void check_solution(const Space& space, const Solution& solution) {
  const auto& region = space.mesh().region;
  const auto layer = std::count(region.begin(), region.end(), Region::layer);
  const Eigen::Index rows = layer * strain_quadrature(space.element()).weights.size();
  if (solution.u.size() != space.size() || (solution.p.size() != 0 && solution.p.size() != rows))
    throw Error(
        fmt::format("errors: a solution of {} unknowns and {} layer stresses; accepted: {} and {}, "
                    "of this space",
                    solution.u.size(), solution.p.size(), space.size(), rows));
}

}  // namespace

ExactPoint Reference::known(const Eigen::Vector2d& x, bool in_layer) const {
  if (at) return at(x(0), x(1));
  return {value(x(0), x(1)), gradient(x(0), x(1)), in_layer ? layer_stress(x(0), x(1)) : 0};
}

Reference reference(const ExactTable& table) {
  return {[&table](double x, double y) { return table.value(x, y); },
          {},
          {},
          [&table](double x, double y) { return table.at(x, y); }};
}

Errors measure_errors(const Space& space, const Solution& solution, double epsilon,
                      const Reference& reference) {
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  check_solution(space, solution);
  const Quadrature& rule = load_rule(element);
  const Eigen::Index points = rule.weights.size();
  std::vector<Eigen::VectorXd> basis, sample_basis;
  std::vector<Eigen::MatrixX3d> derivative;
  for (Eigen::Index q = 0; q < points; ++q) {
    basis.push_back(element.basis(rule.points.row(q)));
    derivative.push_back(element.derivative(rule.points.row(q)));
  }
  for (const Eigen::Vector3d& lambda : sample_points())
    sample_basis.push_back(element.basis(lambda));

  Errors errors;
  const Eigen::VectorXd exact_dofs = dof_values(space, reference.value);
  for (int i = 0; i < space.size(); ++i)
    errors.max_at_unknowns =
        larger(errors.max_at_unknowns, std::abs(solution.u(i) - exact_dofs(i)));
  double l2 = 0, gradient2 = 0;
  errors.by_triangle.setZero(mesh.triangle_count());
  Eigen::Index row = 0;
  const Eigen::MatrixXd stress = layer_stress_values(element, rule.points);
  Eigen::VectorXd u(space.cell_dofs().cols());
  Eigen::MatrixX2d slopes(
      u.size(), 2);  // of the basis; here, since both would be allocated per triangle and point
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    u = solution.u(space.cell_dofs().row(t));
    for (std::size_t k = 0; k < sample_basis.size(); ++k) {
      const Eigen::Vector2d x = point_in(mesh, t, sample_points()[k]);
      errors.max =
          larger(errors.max, std::abs(u.dot(sample_basis[k]) - reference.value(x(0), x(1))));
    }
    const Eigen::Matrix<double, 3, 2> lambda = barycentric_gradients(mesh, t);
    double& energy2 = errors.by_triangle(t);
    const bool in_layer = mesh.region[t] == Region::layer;
    const bool stiff = in_layer && solution.p.size() > 0;
    for (Eigen::Index q = 0; q < points; ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
      const double weight = rule.weights(q) * mesh.area(t);
      const ExactPoint exact = reference.known(x, stiff);
      const double e = u.dot(basis[q]) - exact.value;
      slopes.noalias() = derivative[q] * lambda;
      const Eigen::Vector2d de = slopes.transpose() * u - exact.gradient;
      l2 += weight * e * e;
      gradient2 += weight * de.squaredNorm();
      if (stiff) {
        // epsilon^-2 (d/dy e)^2 = epsilon^2 (p_h - p)^2, which also holds at epsilon = 0
        const double dp =
            stress.row(q).dot(solution.p.segment(row, stress.cols())) - exact.layer_stress;
        energy2 += weight * (de(0) * de(0) + epsilon * epsilon * dp * dp);
      } else {
        energy2 += weight * de.squaredNorm();
      }
    }
    if (in_layer) row += stress.cols();
  }
  errors.l2 = std::sqrt(l2);
  errors.h1 = std::sqrt(l2 + gradient2);
  errors.energy = std::sqrt(errors.by_triangle.sum());
  errors.by_triangle = errors.by_triangle.cwiseSqrt();
  return errors;
}

double slope(const std::vector<double>& h, const std::vector<double>& errors) {
  if (h.size() != errors.size() || h.size() < 2)
    throw Error(fmt::format(
        "slope: {} errors for {} mesh widths; accepted: one per width, of two widths or more",
        errors.size(), h.size()));
  const Eigen::ArrayXd x =
      Eigen::Map<const Eigen::ArrayXd>(h.data(), static_cast<Eigen::Index>(h.size())).log();
  const Eigen::ArrayXd y =
      Eigen::Map<const Eigen::ArrayXd>(errors.data(), static_cast<Eigen::Index>(errors.size()))
          .log();
  const Eigen::ArrayXd dx = x - x.mean();
  return (dx * (y - y.mean())).sum() / dx.square().sum();
}

double energy(const VariationalInequality& problem, const Solution& solution) {
  if (solution.u.size() != problem.size() || solution.p.size() != problem.b.rows())
    throw Error(fmt::format(
        "energy: a solution of {} unknowns and {} rows of B; accepted: {} and {}, of this problem",
        solution.u.size(), solution.p.size(), problem.size(), problem.b.rows()));
  const double stiff =
      solution.p.dot(problem.compliances().cwiseProduct(problem.m).cwiseProduct(solution.p));
  return 0.5 * (solution.u.dot(problem.a1 * solution.u) + stiff) - problem.load.dot(solution.u) +
         friction_energy(problem.bounds, solution.u);
}

}  // namespace antilock
