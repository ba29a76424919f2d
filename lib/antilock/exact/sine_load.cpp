#include "antilock/exact/sine_load.hpp"

#include <Eigen/QR>
#include <cmath>
#include <numbers>

#include "antilock/exact/wave.hpp"

namespace antilock {
namespace {

constexpr int sine_waves = 32, sine_points = 128, checks = 1 << 15,
              degree = LoadResponse::max_degree;

// Chebyshev's points on [0, 1]: interpolation there loses few digits.
double node(int j) { return (1 - std::cos(std::numbers::pi * (j + 0.5) / (degree + 1))) / 2; }

// The polynomial of least degree through the values at the nodes, to `round_off`.
std::vector<double> polynomial(const Eigen::VectorXd& values, double round_off) {
  for (int d = 0;; ++d) {
    Eigen::MatrixXd powers(degree + 1, d + 1);
    for (int j = 0; j <= degree; ++j)
      for (int k = 0; k <= d; ++k) powers(j, k) = std::pow(node(j), k);
    const Eigen::VectorXd c = powers.colPivHouseholderQr().solve(values);
    if (d == degree || (powers * c - values).lpNorm<Eigen::Infinity>() <= round_off)
      return {c.data(), c.data() + d + 1};
  }
}

}  // namespace

std::optional<SineLoad> as_sine_load(const Field& f) {
  if (const auto* sines = f.target<SineLoad>()) return *sines;
  Eigen::MatrixXd samples(sine_points - 1, degree + 1);
  for (int i = 1; i < sine_points; ++i)
    for (int j = 0; j <= degree; ++j) samples(i - 1, j) = f(double(i) / sine_points, node(j));
  const double largest = samples.cwiseAbs().maxCoeff();
  SineLoad load;
  for (int k = 1; k <= sine_waves; ++k) {
    Eigen::VectorXd sines(sine_points - 1);
    for (int i = 1; i < sine_points; ++i)
      sines(i - 1) = std::sin(std::numbers::pi * std::fmod(double(k) * i / sine_points, 2.0));
    const Eigen::VectorXd profile = samples.transpose() * sines * (2.0 / sine_points);
    // sums of 127 products of round-off
    if (profile.lpNorm<Eigen::Infinity>() > 1e-13 * largest)
      load.modes.push_back({k, polynomial(profile, 1e-13 * largest)});
  }
  // points of the golden section: none of them is one of the samples, and of any 1e-4 of the width
  // some see it
  for (int n = 1; n <= checks; ++n) {
    const double x = std::fmod(n * 0.6180339887498949, 1.0), y = (n - 0.5) / checks;
    if (!(std::abs(f(x, y) - load(x, y)) <= 1e-11 * largest)) return {};
  }
  return load;
}

std::optional<ExactSolution> exact_solution_of(const Scene& scene, int log2_points) {
  if (!std::holds_alternative<StiffLayer>(scene.layer()) &&
      !std::holds_alternative<VentcelLayer>(scene.layer()))
    return {};
  if (!scene.beyond_the_paper().empty()) return {};
  for (int j = 0; scene.contact() && j <= checks; ++j)
    if (scene.contact()->gap(double(j) / checks) != 0) return {};
  const std::optional<SineLoad> load = as_sine_load(scene.body().load);
  if (!load) return {};
  return ExactSolution(*load, *scene.epsilon(), scene.contact().has_value(), log2_points);
}

}  // namespace antilock
