#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "antilock/core/error.hpp"
#include "antilock/exact/exact_solution_data.hpp"

namespace antilock {
namespace {

constexpr double nothing = 1e-19;  // factors below are not summed

// sinh(kappa t) / sinh(kappa) for kappa < 1, without the cancellation of exponentials; six terms
// reach 1e-16.
double small_ratio(double kappa, double t) {
  if (kappa == 0) return t;
  const auto sinhc = [](double s) {  // sinh(x) / x by s = x^2
    return 1 + s / 6 *
                   (1 + s / 20 *
                            (1 + s / 42 *
                                     (1 + s / 72 * (1 + s / 110 * (1 + s / 156 * (1 + s / 210))))));
  };
  return t * sinhc(kappa * kappa * t * t) / sinhc(kappa * kappa);
}

// r^k by repeated multiplication, k = 1, 2, ..., and 0 long before r^k is no normal number any
// more: a product with such a number takes a hundred times as long as any other.
struct Powers {
  double r, value = 1;
  double next() {
    value *= r;
    if (value < 1e-200) value = 0;
    return value;
  }
};

// Room for the waves whose factor e^{-decay k} is summed, and a few more: far from Gamma_C and
// Sigma few of all.
SineRow empty_row(double decay, Eigen::Index all) {
  const double most = 3 - std::log(nothing) / decay;
  const Eigen::Index size =
      decay > 0 && most < static_cast<double>(all) ? static_cast<Eigen::Index>(most) : all;
  return {Eigen::VectorXd::Zero(size), Eigen::VectorXd::Zero(size), Eigen::VectorXd::Zero(size)};
}

// Grown, it is filled with zeros.
void resize(SineRow& row, Eigen::Index size) {
  for (Eigen::VectorXd* const series : {&row.u, &row.p, &row.p_y}) {
    const Eigen::Index before = series->size();
    series->conservativeResize(size);
    if (size > before) series->tail(size - before).setZero();
  }
}

}  // namespace

double SineRow::a(Eigen::Index k) const { return double(k) * std::numbers::pi; }

// Body: u_k = w_k sinh(a(1-y)) / sinh(a) + G_k(y), with the sinh ratio (e^{-ay} - e^{-a(2-y)}) /
// (1 - e^{-2a}).
SineRow body_row(const ExactSolution::Data& exact, double y) {
  const Eigen::VectorXd& w = exact.on_sigma;
  SineRow row = empty_row(std::numbers::pi * y, w.size());
  Powers near{std::exp(-std::numbers::pi * y)}, far{std::exp(-std::numbers::pi * (2 - y))};
  Powers twice{std::exp(-2 * std::numbers::pi)};
  Eigen::Index k = 1;
  for (; k < row.u.size() && near.value > nothing; ++k) {
    const double e = near.next(), back = far.next(), scale = 1 / (1 - twice.next());
    row.u(k) = w(k) * (e - back) * scale;
    row.p(k) = -row.a(k) * w(k) * (e + back) * scale;
    row.p_y(k) = row.a(k) * row.a(k) * exact.filter(k) * row.u(k);
  }
  const Eigen::Index load_end = exact.load.empty() ? 1 : exact.load.back().k() + 1;
  resize(row, std::max(k, load_end));
  for (const LoadResponse& load : exact.load) {
    const double a = row.a(load.k());
    row.u(load.k()) += load.value(y);
    row.p(load.k()) += load.slope(y);
    row.p_y(load.k()) += a * a * load.value(y) - load.force(y);
  }
  return row;
}

// Layer: u and p both solve v'' = kappa^2 v, so each is its value on Sigma times sinh(kappa eta) /
// sinh(kappa) plus its value on Gamma_C times sinh(kappa (1-eta)) / sinh(kappa), eta = 1 + y.
// Nothing divides by epsilon: at 0 both are linear in y.
SineRow layer_row(const ExactSolution::Data& exact, double y) {
  const double eta = 1 + y;
  const double step = exact.epsilon * std::numbers::pi;
  SineRow row = empty_row(step * std::min(eta, -y), exact.on_sigma.size());
  Powers from_gamma_c{std::exp(-step * eta)}, from_sigma{std::exp(step * y)};
  Eigen::Index k = 1;
  for (; k < row.u.size(); ++k) {
    const double down = from_gamma_c.next(), up = from_sigma.next(), kappa = step * double(k);
    if (std::max(down, up) < nothing) break;
    const double both = down * up;  // e^{-kappa}
    const double sigma =
        kappa < 1 ? small_ratio(kappa, eta) : (up - down * both) / (1 - both * both);
    const double gamma_c =
        kappa < 1 ? small_ratio(kappa, -y) : (down - up * both) / (1 - both * both);
    row.u(k) = exact.on_sigma(k) * sigma + exact.on_gamma_c(k) * gamma_c;
    row.p(k) = exact.stress_sigma(k) * sigma + exact.stress_gamma_c(k) * gamma_c;
    row.p_y(k) = row.a(k) * row.a(k) * exact.filter(k) * row.u(k);
  }
  resize(row, k);
  return row;
}

Eigen::Vector2d inside_domain(double x, double y) {
  const double slack = 1e-9;  // what meshes in single precision or a file's rounding may be off
  if (!(x >= -slack && x <= 1 + slack && y >= -1 - slack && y <= 1 + slack))
    throw Error(fmt::format(
        "exact solution: point ({}, {}) is outside the domain; accepted: 0 <= x <= 1, -1 <= y <= 1",
        x, y));
  return {std::clamp(x, 0.0, 1.0), std::clamp(y, -1.0, 1.0)};
}

}  // namespace antilock
