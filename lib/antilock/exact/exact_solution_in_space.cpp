#include "antilock/exact/exact_solution_in_space.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

void check_point(double x, double y, double z, double top) {
  if (!(x >= 0 && x <= 1 && y >= 0 && y <= 1 && z >= -1 && z <= top))
    throw Error(fmt::format(
        "exact solution: the point ({:.6g}, {:.6g}, {:.6g}) is outside; accepted: 0 <= x, y <= 1 "
        "and -1 <= z <= {}",
        x, y, z, top));
}

void check_mode(const DoubleSineMode& mode) {
  if (mode.k < 1 || mode.l < 1)
    throw Error(
        fmt::format("exact solution: wave numbers {} and {}; accepted: 1 or more", mode.k, mode.l));
  if (mode.profile.size() > WaveResponse::max_degree + 1)
    throw Error(fmt::format("exact solution: a profile of {} coefficients; accepted: up to {}",
                            mode.profile.size(), WaveResponse::max_degree + 1));
}

}  // namespace

// The bottom is free: the layer pulls on Sigma with R w, and the body with G'(0) - T w (wave.hpp).
// So w = G'(0) / (T + R).
ExactSolutionInSpace::ExactSolutionInSpace(const std::vector<DoubleSineMode>& load, double epsilon)
    : epsilon_(epsilon) {
  if (!(epsilon >= 0 && epsilon <= 1))
    throw Error(fmt::format("exact solution: epsilon = {}; accepted: 0 to 1", epsilon));
  for (const DoubleSineMode& mode : load) {
    check_mode(mode);
    const double along_x = mode.k * std::numbers::pi, along_y = mode.l * std::numbers::pi;
    WaveResponse response(std::hypot(along_x, along_y), mode.profile);
    const Symbols symbols(response.a(), epsilon);
    const double on_sigma = response.pull() / (symbols.body + symbols.layer);
    terms_.push_back({along_x, along_y, on_sigma, std::move(response)});
  }
}

ExactSolutionInSpace::Amplitude ExactSolutionInSpace::in_body(const Term& term, double z) const {
  const double a = term.response.a();
  const double slope = term.response.slope(z) - a * term.on_sigma * decay_slope(a, z);
  return {term.response.value(z) + term.on_sigma * decay(a, z), slope, slope};
}

// u = w cosh(kappa eta) / cosh(kappa), kappa = epsilon a, eta = 1 + z, by decaying exponentials.
// stress is w a^2 eta sinh(kappa eta) / (kappa eta cosh(kappa)), and w a^2 eta at kappa = 0.
ExactSolutionInSpace::Amplitude ExactSolutionInSpace::in_layer(const Term& term, double z) const {
  const double a = term.response.a();
  const double kappa = epsilon_ * a;
  const double eta = 1 + z;
  const double scale = term.on_sigma * std::exp(kappa * z) / (1 + std::exp(-2 * kappa));
  const double value = scale * (1 + std::exp(-2 * kappa * eta));
  double stress = term.on_sigma * a * a * eta;
  if (kappa * eta > 0) stress = scale * a * a * -std::expm1(-2 * kappa * eta) / kappa;
  return {value, epsilon_ * epsilon_ * stress, stress};
}

double ExactSolutionInSpace::force(double x, double y, double z) const {
  double sum = 0;
  for (const Term& term : terms_)
    sum += term.response.force(z) * std::sin(term.along_x * x) * std::sin(term.along_y * y);
  return sum;
}

double ExactSolutionInSpace::value(double x, double y, double z) const {
  check_point(x, y, z, 1);
  double sum = 0;
  for (const Term& term : terms_) {
    const Amplitude at = z < 0 ? in_layer(term, z) : in_body(term, z);
    sum += at.value * std::sin(term.along_x * x) * std::sin(term.along_y * y);
  }
  return sum;
}

Eigen::Vector3d ExactSolutionInSpace::gradient(double x, double y, double z) const {
  check_point(x, y, z, 1);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Term& term : terms_) {
    const Amplitude at = z < 0 ? in_layer(term, z) : in_body(term, z);
    const double sine_x = std::sin(term.along_x * x), sine_y = std::sin(term.along_y * y);
    sum(0) += at.value * term.along_x * std::cos(term.along_x * x) * sine_y;
    sum(1) += at.value * term.along_y * std::cos(term.along_y * y) * sine_x;
    sum(2) += at.slope * sine_x * sine_y;
  }
  return sum;
}

double ExactSolutionInSpace::layer_stress(double x, double y, double z) const {
  check_point(x, y, z, 0);
  double sum = 0;
  for (const Term& term : terms_)
    sum += in_layer(term, z).stress * std::sin(term.along_x * x) * std::sin(term.along_y * y);
  return sum;
}

}  // namespace antilock
