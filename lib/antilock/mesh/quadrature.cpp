#include "antilock/mesh/quadrature.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"

namespace antilock {

// Eigenvalues of the Jacobi matrix of Legendre's polynomials (Golub and Welsch 1969).
std::pair<Eigen::VectorXd, Eigen::VectorXd> gauss_rule(int n) {
  if (n < 1 || n > 1000)
    throw Error(fmt::format("quadrature: Gauss's rule of {} points; accepted: 1 to 1000", n));
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(n, n);
  for (int k = 1; k < n; ++k) jacobi(k, k - 1) = k / std::sqrt(4.0 * k * k - 1);
  const auto [values, vectors] = symmetric_eigen(jacobi);
  return {(1 + values.array()) / 2, vectors.row(0).transpose().array().square()};
}

namespace {

/// The square folded onto the triangle, (s, t) -> lambda = (s, (1 - s) t, (1 - s)(1 - t)): its area
/// element is (1 - s).
Quadrature conical_rule(int degree) {
  const int n = (degree + 3) / 2;  // in s the polynomial is of degree + 1
  const auto [points, weights] = gauss_rule(n);
  Quadrature rule{ReferencePoints(n * n, 3), Eigen::VectorXd(n * n)};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double s = points(i), t = points(j);
      rule.points.row(n * i + j) << s, (1 - s) * t, (1 - s) * (1 - t);
      rule.weights(n * i + j) = 2 * weights(i) * weights(j) * (1 - s);
    }
  return rule;
}

/// J. Radon, Zur mechanischen Kubatur, 1948
Quadrature radons_rule() {
  const double s = std::sqrt(15.0), a = (6 - s) / 21, b = (6 + s) / 21;
  Quadrature rule{ReferencePoints(7, 3), Eigen::VectorXd(7)};
  rule.points << Eigen::RowVector3d::Constant(1.0 / 3), Eigen::Matrix3d::Constant(a),
      Eigen::Matrix3d::Constant(b);
  rule.points.diagonal(-1).setConstant(1 - 2 * a);
  rule.points.diagonal(-4).setConstant(1 - 2 * b);
  rule.weights << 9.0 / 40, Eigen::Vector3d::Constant((155 - s) / 1200),
      Eigen::Vector3d::Constant((155 + s) / 1200);
  return rule;
}

/// The cube folded onto the tetrahedron: (s, mu) -> lambda = (s, (1 - s) mu) for a point mu of the
/// triangle. Its volume element is (1 - s)^2.
Quadrature conical_rule_in_space(int degree) {
  const int n = (degree + 4) / 2;  // in s the polynomial is of degree + 2
  const auto [points, weights] = gauss_rule(n);
  const Quadrature& base = triangle_rule(degree);
  const Eigen::Index m = base.weights.size();
  Quadrature rule{ReferencePoints(n * m, 4), Eigen::VectorXd(n * m)};
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < m; ++j) {
      const double s = points(i);
      rule.points.row(m * i + j) << s, (1 - s) * base.points.row(j);
      rule.weights(m * i + j) = 3 * weights(i) * base.weights(j) * (1 - s) * (1 - s);
    }
  return rule;
}

/// P. C. Hammer and A. H. Stroud, Math. Tables Aids Comput. 10, 1956
Quadrature four_point_rule() {
  const double b = (5 - std::sqrt(5.0)) / 20;
  return {ReferencePoints::Constant(4, 4, b) + (1 - 4 * b) * ReferencePoints::Identity(4, 4),
          Eigen::VectorXd::Constant(4, 0.25)};
}

Quadrature square_rule(int degree) {
  const int n = degree / 2 + 1;
  const auto [points, weights] = gauss_rule(n);
  Quadrature rule{ReferencePoints(n * n, 2), Eigen::VectorXd(n * n)};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      rule.points.row(n * i + j) << points(i), points(j);
      rule.weights(n * i + j) = weights(i) * weights(j);
    }
  return rule;
}

constexpr int largest_degree = 12;

void check_degree(int degree) {
  if (degree < 0 || degree > largest_degree)
    throw Error(
        fmt::format("quadrature: degree {} is not accepted; 0 to {}", degree, largest_degree));
}

}  // namespace

const Quadrature& cell_rule(CellKind kind, int degree) {
  if (kind == CellKind::triangle) return triangle_rule(degree);
  check_degree(degree);
  using Rules = std::array<Quadrature, largest_degree + 1>;
  static const Rules tetrahedra = [] {
    Rules r;
    r[0] = r[1] = {ReferencePoints::Constant(1, 4, 0.25), Eigen::VectorXd::Ones(1)};
    r[2] = four_point_rule();
    for (int d = 3; d <= largest_degree; ++d) r[d] = conical_rule_in_space(d);
    return r;
  }();
  static const Rules squares = [] {
    Rules r;
    for (int d = 0; d <= largest_degree; ++d) r[d] = square_rule(d);
    return r;
  }();
  return kind == CellKind::tetrahedron ? tetrahedra[degree] : squares[degree];
}

Quadrature facet_rule(CellKind kind, int degree) {
  if (kind == CellKind::tetrahedron) return triangle_rule(degree);
  const auto [points, weights] = gauss_rule(degree / 2 + 1);
  Quadrature rule{ReferencePoints(points.size(), 2), weights};
  rule.points << (1 - points.array()).matrix(), points;
  return rule;
}

ReferencePoint on_facet(CellKind kind, int i, const ReferencePoint& mu) {
  const ReferenceCell& cell = reference_cell(kind);
  ReferencePoint xi = ReferencePoint::Zero(cell.coordinates);
  for (int k = 0; k < cell.dimension; ++k) xi += mu(k) * reference_vertex(kind, cell.facet[i][k]);
  return xi;
}

const Quadrature& triangle_rule(int degree) {
  check_degree(degree);
  static const std::array<Quadrature, largest_degree + 1> rules = [] {
    std::array<Quadrature, largest_degree + 1> r;
    r[0] = r[1] = {Eigen::RowVector3d::Constant(1.0 / 3), Eigen::VectorXd::Ones(1)};
    r[2] = {0.5 * (Eigen::Matrix3d::Ones() - Eigen::Matrix3d::Identity()),
            Eigen::Vector3d::Constant(1.0 / 3)};
    r[3] = r[4] = r[5] = radons_rule();
    for (int d = 6; d <= largest_degree; ++d) r[d] = conical_rule(d);
    return r;
  }();
  return rules[degree];
}
const Quadrature& midpoint_rule() { return triangle_rule(2); }
const Quadrature& radon_rule() { return triangle_rule(5); }

Eigen::Vector3d on_edge(int i, double s) {
  const Eigen::Matrix3d corner = Eigen::Matrix3d::Identity();
  return (1 - s) * corner.col((i + 1) % 3) + s * corner.col((i + 2) % 3);
}

}  // namespace antilock
