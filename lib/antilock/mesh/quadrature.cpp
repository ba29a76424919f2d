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
  Quadrature rule{Eigen::MatrixX3d(n * n, 3), Eigen::VectorXd(n * n)};
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
  Quadrature rule{Eigen::MatrixX3d(7, 3), Eigen::VectorXd(7)};
  rule.points << Eigen::RowVector3d::Constant(1.0 / 3), Eigen::Matrix3d::Constant(a),
      Eigen::Matrix3d::Constant(b);
  rule.points.diagonal(-1).setConstant(1 - 2 * a);
  rule.points.diagonal(-4).setConstant(1 - 2 * b);
  rule.weights << 9.0 / 40, Eigen::Vector3d::Constant((155 - s) / 1200),
      Eigen::Vector3d::Constant((155 + s) / 1200);
  return rule;
}

}  // namespace

const Quadrature& triangle_rule(int degree) {
  constexpr int most = 12;
  if (degree < 0 || degree > most)
    throw Error(fmt::format("quadrature: degree {} is not accepted; 0 to {}", degree, most));
  static const std::array<Quadrature, most + 1> rules = [] {
    std::array<Quadrature, most + 1> r;
    r[0] = r[1] = {Eigen::RowVector3d::Constant(1.0 / 3), Eigen::VectorXd::Ones(1)};
    r[2] = {0.5 * (Eigen::Matrix3d::Ones() - Eigen::Matrix3d::Identity()),
            Eigen::Vector3d::Constant(1.0 / 3)};
    r[3] = r[4] = r[5] = radons_rule();
    for (int d = 6; d <= most; ++d) r[d] = conical_rule(d);
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
