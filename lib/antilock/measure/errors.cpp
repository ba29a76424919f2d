#include "antilock/measure/errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/exact/exact_table.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/space/cell_map.hpp"

namespace antilock {
namespace {

/// The lattice of order 4 of a cell: corners, edge midpoints and quarters, inner points.
std::vector<ReferencePoint> sample_points(CellKind kind) {
  constexpr int order = 4;
  const bool in_space = kind == CellKind::tetrahedron;
  std::vector<ReferencePoint> points;
  if (!reference_cell(kind).simplex) {
    for (int i = 0; i <= order; ++i)
      for (int j = 0; j <= order; ++j) points.emplace_back(Eigen::Vector2d(i, j) / order);
    return points;
  }
  for (int i = 0; i <= order; ++i)
    for (int j = 0; i + j <= order; ++j) {
      const int rest = order - i - j;
      if (!in_space) points.emplace_back(Eigen::Vector3d(i, j, rest) / order);
      for (int k = 0; in_space && k <= rest; ++k)
        points.emplace_back(Eigen::Vector4d(i, j, k, rest - k) / order);
    }
  return points;
}

/// The monomials lambda_0^i lambda_1^j, i + j <= degree, at each point; in space those of three
/// coordinates.
Eigen::MatrixXd monomials(const ReferencePoints& points, int degree) {
  const int most = points.cols() == 4 ? degree : 0;  // exponent of lambda_2
  std::vector<Eigen::ArrayXd> columns;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j)
      for (int k = 0; k <= std::min(most, degree - i - j); ++k) {
        columns.emplace_back(points.col(0).array().pow(i) * points.col(1).array().pow(j));
        if (k > 0) columns.back() *= points.col(2).array().pow(k);
      }
  Eigen::MatrixXd values(points.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t column = 0; column < columns.size(); ++column)
    values.col(static_cast<Eigen::Index>(column)) = columns[column];
  return values;
}

/// The monomials s^i t^j, i and j <= degree, at each point of a square.
Eigen::MatrixXd products(const ReferencePoints& points, int degree) {
  Eigen::MatrixXd values(points.rows(), Eigen::Index(degree + 1) * (degree + 1));
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; j <= degree; ++j)
      values.col(Eigen::Index(i) * (degree + 1) + j) =
          points.col(0).array().pow(i) * points.col(1).array().pow(j);
  return values;
}

/// The values of p_h at `points`, from the rows of B of a cell. On a simplex p_h is of degree k -
/// 1. On a quadrilateral it is the polynomial in s and t through its values at the points of the
/// rows: bilinear for two by two points, and constant for one.
Eigen::MatrixXd layer_stress_values(const Element& element, const ReferencePoints& points) {
  const ReferencePoints& rows = strain_quadrature(element).points;
  if (!reference_cell(element.kind()).simplex) {
    const int degree = element.strain_degree() / 2;
    return products(points, degree) * pseudo_inverse(products(rows, degree));
  }
  const int degree = element.degree() - 1;
  const Eigen::MatrixXd at_rows = monomials(rows, degree);
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

/// The reference at a point.
template <int d>
struct Known {
  double value;
  Eigen::Matrix<double, d, 1> gradient;
  double layer_stress;
};

template <int d>
Known<d> known_at(const Reference& reference, const Eigen::Matrix<double, d, 1>& x, bool in_layer) {
  if constexpr (d == 2) {
    const ExactPoint exact = reference.known(x, in_layer);
    return {exact.value, exact.gradient, exact.layer_stress};
  } else {
    return {reference.value(x(0), x(1), x(2)), reference.gradient(x(0), x(1), x(2)),
            in_layer ? reference.layer_stress(x(0), x(1), x(2)) : 0};
  }
}

/// L-infinity at the samples of every cell.
template <CellKind kind>
double largest_error(const Space& space, const Solution& solution, const Reference& reference) {
  constexpr int d = reference_cell(kind).dimension;
  const std::vector<ReferencePoint> samples = sample_points(kind);
  std::vector<Eigen::VectorXd> basis;
  for (const ReferencePoint& lambda : samples) basis.push_back(space.element().basis(lambda));
  double largest = 0;
  Eigen::VectorXd u(space.cell_dofs().cols());
  for (int t = 0; t < space.mesh().triangle_count(); ++t) {
    u = solution.u(space.cell_dofs().row(t));
    const CellMap<kind> map(space.mesh(), t);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const Eigen::Matrix<double, d, 1> x = map.point(samples[k]);
      double exact = 0;
      if constexpr (d == 2)
        exact = reference.value(x(0), x(1));
      else
        exact = reference.value(x(0), x(1), x(2));
      largest = larger(largest, std::abs(u.dot(basis[k]) - exact));
    }
  }
  return largest;
}

/// The errors in L2, H1 and the energy norm.
template <CellKind kind>
void add_errors_on_cells(Errors& errors, const Space& space, const Solution& solution,
                         double epsilon, const Reference& reference) {
  constexpr int c = reference_cell(kind).coordinates, d = reference_cell(kind).dimension;
  using Vector = Eigen::Matrix<double, d, 1>;
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  const Quadrature& rule = load_rule(element);
  const Eigen::Index points = rule.weights.size();
  std::vector<Eigen::VectorXd> basis;
  std::vector<Eigen::Matrix<double, Eigen::Dynamic, c>> derivative;
  for (Eigen::Index q = 0; q < points; ++q) {
    basis.push_back(element.basis(rule.points.row(q)));
    derivative.push_back(element.derivative(rule.points.row(q)));
  }

  double l2 = 0, gradient2 = 0;
  errors.by_triangle.setZero(mesh.triangle_count());
  Eigen::Index row = 0;
  const Eigen::MatrixXd stress = layer_stress_values(element, rule.points);
  Eigen::VectorXd u(space.cell_dofs().cols());
  Eigen::Matrix<double, Eigen::Dynamic, d> slopes(
      u.size(), d);  // of the basis; here, since both would be allocated per cell and point
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    u = solution.u(space.cell_dofs().row(t));
    const CellMap<kind> map(mesh, t);
    auto here = map.at(rule.points.row(0).transpose());  // on a simplex the same at every point
    double& energy2 = errors.by_triangle(t);
    const bool in_layer = mesh.region[t] == Region::layer;
    const bool stiff = in_layer && solution.p.size() > 0;
    for (Eigen::Index q = 0; q < points; ++q) {
      if constexpr (!reference_cell(kind).simplex) here = map.at(rule.points.row(q).transpose());
      const Vector x = map.point(rule.points.row(q).transpose());
      const double weight = rule.weights(q) * here.factor;
      const Known<d> exact = known_at<d>(reference, x, stiff);
      const double e = u.dot(basis[q]) - exact.value;
      slopes.noalias() = derivative[q] * here.gradient;
      const Vector de = slopes.transpose() * u - exact.gradient;
      l2 += weight * e * e;
      gradient2 += weight * de.squaredNorm();
      if (stiff) {
        // epsilon^-2 (d/dy e)^2 = epsilon^2 (p_h - p)^2, which also holds at epsilon = 0
        const double dp =
            stress.row(q).dot(solution.p.segment(row, stress.cols())) - exact.layer_stress;
        const double along = de.template head<d - 1>().squaredNorm();
        energy2 += weight * (along + epsilon * epsilon * dp * dp);
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
}

}  // namespace

ExactPoint Reference::known(const Eigen::Vector2d& x, bool in_layer) const {
  if (at) return at(x(0), x(1));
  return {value(x(0), x(1)), gradient(x(0), x(1)).head<2>(),
          in_layer ? layer_stress(x(0), x(1)) : 0};
}

Reference reference(const ExactTable& table) {
  return {[&table](double x, double y) { return table.value(x, y); },
          {},
          {},
          [&table](double x, double y) { return table.at(x, y); }};
}

Errors measure_errors(const Space& space, const Solution& solution, double epsilon,
                      const Reference& reference) {
  check_solution(space, solution);
  Errors errors;
  const Eigen::VectorXd exact_dofs = dof_values(space, reference.value);
  for (int i = 0; i < space.size(); ++i)
    errors.max_at_unknowns =
        larger(errors.max_at_unknowns, std::abs(solution.u(i) - exact_dofs(i)));
  with_kind(space.mesh().kind, [&]<CellKind kind>() {
    errors.max = largest_error<kind>(space, solution, reference);
    add_errors_on_cells<kind>(errors, space, solution, epsilon, reference);
  });
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
