#include "antilock/exact/truth_distance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "antilock/exact/detail/truth_data.hpp"
#include "antilock/form/quadrature.hpp"

namespace antilock {
namespace {

// int_0^1 (e^2 + e_x^2 + e_y^2) dx on a row, e = sum e_k sin(k pi x), e_y = scale p: int sin^2 = int cos^2 = 1/2.
double row_square(const SineRow& a, double scale_a, const SineRow& b, double scale_b) {
  double sum = 0;
  for (Eigen::Index k = 1; k < std::max(a.u.size(), b.u.size()); ++k) {
    const double u = (k < a.u.size() ? a.u(k) : 0) - (k < b.u.size() ? b.u(k) : 0);
    const double slope = (k < a.p.size() ? scale_a * a.p(k) : 0) - (k < b.p.size() ? scale_b * b.p(k) : 0);
    sum += 0.5 * ((1 + a.a(k) * a.a(k)) * u * u + slope * slope);
  }
  return sum;
}

// The same of u^2 + |grad u|^2 + u_xx^2 + 2 u_xy^2 + u_yy^2, u_y = scale p.
double row_square_2(const SineRow& row, double scale) {
  double sum = 0;
  for (Eigen::Index k = 1; k < row.u.size(); ++k) {
    const double a2 = row.a(k) * row.a(k), u2 = row.u(k) * row.u(k), slope2 = std::pow(scale * row.p(k), 2);
    sum += 0.5 * ((1 + a2 + a2 * a2) * u2 + (1 + 2 * a2) * slope2 + std::pow(scale * row.p_y(k), 2));
  }
  return sum;
}

// k pi by k
Eigen::ArrayXd waves(const SineRow& row) { return Eigen::ArrayXd::LinSpaced(row.u.size(), 0, row.a(row.u.size() - 1)); }

// Gauss' rule on cells that shrink by half towards both ends of (0, 1), 16 times: high waves live within 1/k of Sigma
// and, in the layer, within 1/(epsilon k) of either side. Good to 1e-6.
template <class Row>
double integral(Row&& row) {
  static const auto rule = gauss_rule(5);
  double sum = 0, from = 0;
  for (int cell = 16; cell >= 1; --cell) {
    const double to = std::ldexp(1.0, -cell);
    for (Eigen::Index q = 0; q < rule.first.size(); ++q) {
      const double t = from + (to - from) * rule.first(q);
      sum += (to - from) * rule.second(q) * (row(t) + row(1 - t));
    }
    from = to;
  }
  return sum;
}

}  // namespace

double h1_distance(const Truth& a, const Truth& b) {
  const Truth::Data &one = a.data(), &two = b.data();
  const double body = integral([&](double y) { return row_square(body_row(one, y), 1, body_row(two, y), 1); });
  const double scale_one = one.epsilon * one.epsilon, scale_two = two.epsilon * two.epsilon;
  const double layer = integral(
      [&](double t) { return row_square(layer_row(one, t - 1), scale_one, layer_row(two, t - 1), scale_two); });
  return std::sqrt(body + layer);
}

double h2_norm(const Truth& truth) {
  const Truth::Data& data = truth.data();
  const double scale = data.epsilon * data.epsilon;
  return std::sqrt(integral([&](double y) { return row_square_2(body_row(data, y), 1); })) +
         std::sqrt(integral([&](double t) { return row_square_2(layer_row(data, t - 1), scale); }));
}

double stress_norm(const Truth& truth) {
  return std::sqrt(integral([&](double t) { return 0.5 * layer_row(truth.data(), t - 1).p.squaredNorm(); }));
}

double layer_norm(const Truth& truth) {
  const Truth::Data& data = truth.data();
  const SineRow none{};
  return std::sqrt(
      integral([&](double t) { return row_square(layer_row(data, t - 1), data.epsilon * data.epsilon, none, 0); }));
}

double clamped_distance(const Truth& limit) {
  const Eigen::VectorXd& w = limit.data().on_sigma;
  double sum = std::pow(layer_norm(limit), 2);
  for (Eigen::Index k = 1; k < w.size(); ++k) {  // 1/2 w^2 (int |grad|^2 + int v^2 of sinh(a (1 - y)) / sinh(a))
    const double a = static_cast<double>(k) * std::numbers::pi, coth = 1 / std::tanh(a);
    sum += 0.5 * w(k) * w(k) * (a * coth + 0.5 * (coth / a - 1 / std::pow(std::sinh(a), 2)));
  }
  return std::sqrt(sum);
}

Regularity regularity(const Truth& truth) {
  const Truth::Data& data = truth.data();
  const double e2 = data.epsilon * data.epsilon;
  Regularity squares;
  squares.body = integral([&](double y) {
    const SineRow row = body_row(data, y);
    const Eigen::ArrayXd a = waves(row);
    return 0.5 * ((a * a * row.u.array()).square() + 2 * (a * row.p.array()).square() + row.p_y.array().square()).sum();
  });
  squares.stress_x = integral([&](double t) {
    const SineRow row = layer_row(data, t - 1);
    return 0.5 * (waves(row) * row.p.array()).square().sum();
  });
  squares.layer =
      integral([&](double t) { return 0.5 * layer_row(data, t - 1).p_y.squaredNorm(); }) + e2 * squares.stress_x;
  return squares;
}

}  // namespace antilock
