#include "antilock/exact/exact_norms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "antilock/exact/exact_solution_data.hpp"
#include "antilock/mesh/quadrature.hpp"

namespace antilock {
namespace {

/// int_0^1 of u^2, u_x^2, u_xx^2, p^2, p_x^2 and p_y^2 on a row y = const; then their integrals
/// over y.
using Squares = Eigen::Array<double, 6, 1>;
enum SquareOf : Eigen::Index { u, u_x, u_xx, p, p_x, p_y };

Squares squares(const SineRow& row) {  // int sin^2 = int cos^2 = 1/2
  const auto a = Eigen::ArrayXd::LinSpaced(row.u.size(), 0, row.a(row.u.size() - 1));  // k pi by k
  Squares s;
  s << row.u.squaredNorm(), (a * row.u.array()).square().sum(),
      (a.square() * row.u.array()).square().sum(), row.p.squaredNorm(),
      (a * row.p.array()).square().sum(), row.p_y.squaredNorm();
  return s / 2;
}

// Gauss' rule on cells that shrink by half towards both ends of (0, 1), 16 times: high waves live
// within 1/k of Sigma and, in the layer, within 1/(epsilon k) of either side. Good to 1e-6.
template <class Row>
Squares integral(Row&& row) {
  static const auto rule = gauss_rule(5);
  Squares sum = Squares::Zero();
  double from = 0;
  for (int cell = 16; cell >= 1; --cell) {
    const double to = std::ldexp(1.0, -cell);
    for (Eigen::Index q = 0; q < rule.first.size(); ++q) {
      const double t = from + (to - from) * rule.first(q);
      sum += (to - from) * rule.second(q) * (squares(row(t)) + squares(row(1 - t)));
    }
    from = to;
  }
  return sum;
}

Squares in_body(const ExactSolution& exact) {
  return integral([&](double y) { return body_row(exact.data(), y); });
}
Squares in_layer(const ExactSolution& exact) {
  return integral([&](double t) { return layer_row(exact.data(), t - 1); });
}

/// e = a - b by its u and, in the place of p, its e_y.
SineRow difference(SineRow a, double scale_a, SineRow b, double scale_b) {
  const Eigen::VectorXd all = Eigen::VectorXd::Zero(std::max(a.u.size(), b.u.size()));
  for (Eigen::VectorXd* const series : {&a.u, &a.p, &b.u, &b.p})
    series->conservativeResizeLike(all);
  return {a.u - b.u, scale_a * a.p - scale_b * b.p, all};
}

double h1_square(const Squares& s, double scale) { return s[u] + s[u_x] + scale * scale * s[p]; }
double h2_square(const Squares& s, double scale) {
  return h1_square(s, scale) + s[u_xx] + scale * scale * (2 * s[p_x] + s[p_y]);
}
double scale_of(const ExactSolution& exact) {
  return exact.epsilon() * exact.epsilon();
}  // u_y = scale p in the layer

}  // namespace

double h1_distance(const ExactSolution& a, const ExactSolution& b) {
  const Squares body = integral(
      [&](double y) { return difference(body_row(a.data(), y), 1, body_row(b.data(), y), 1); });
  const Squares layer = integral([&](double t) {
    return difference(layer_row(a.data(), t - 1), scale_of(a), layer_row(b.data(), t - 1),
                      scale_of(b));
  });
  return std::sqrt(h1_square(body, 1) + h1_square(layer, 1));
}

double h2_norm(const ExactSolution& exact) {
  return std::sqrt(h2_square(in_body(exact), 1)) +
         std::sqrt(h2_square(in_layer(exact), scale_of(exact)));
}

double stress_norm(const ExactSolution& exact) { return std::sqrt(in_layer(exact)[p]); }

double layer_norm(const ExactSolution& exact) {
  return std::sqrt(h1_square(in_layer(exact), scale_of(exact)));
}

double clamped_distance(const ExactSolution& limit) {
  const Eigen::VectorXd& w = limit.data().on_sigma;
  double sum = std::pow(layer_norm(limit), 2);
  for (Eigen::Index k = 1; k < w.size();
       ++k) {  // 1/2 w^2 (int |grad|^2 + int v^2 of sinh(a (1 - y)) / sinh(a))
    const double a = static_cast<double>(k) * std::numbers::pi, coth = 1 / std::tanh(a);
    sum += 0.5 * w(k) * w(k) * (a * coth + 0.5 * (coth / a - 1 / std::pow(std::sinh(a), 2)));
  }
  return std::sqrt(sum);
}

Regularity regularity(const ExactSolution& exact) {
  const Squares body = in_body(exact), layer = in_layer(exact);
  return {body[u_xx] + 2 * body[p_x] + body[p_y], layer[p_y] + scale_of(exact) * layer[p_x],
          layer[p_x]};
}

}  // namespace antilock
