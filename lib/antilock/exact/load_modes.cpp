#include "antilock/exact/load_modes.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <numbers>
#include <vector>

#include "antilock/core/eigen_memory.hpp"
#include "antilock/core/error.hpp"
#include "antilock/exact/wave.hpp"

namespace antilock {

// In the body free on Sigma (u_y = 0 there) the load 2 sin(a x) cos(mu y) gives itself times g = 1
// / (a^2 + mu^2): the basis diagonalises that problem. Let P_k = sum_m g_km f_km be its u on Sigma.
// The layer pulls there with R w, the body gives way by w = P - R w / T, hence w = P T / (T + R),
// and
//     u = sum_k 2 sin(a x) (sum_m g_km f_km cos(mu_m y) - P_k R / (T + R) decay(a, y)),
// since decay(a, 0) = 1 and -decay'(a, 0) = T. With int cos(mu_m y) decay(a, y) dy = T g_km (by
// parts, twice):
//     S f = g f - 2 T R / (T + R) P_k g,    per k a diagonal matrix less one of rank one.
LoadModes::LoadModes(int waves) : waves_(waves) {
  if (waves < 1 || waves > 4096)
    throw Error(fmt::format("loads: {} waves; accepted: 1 to 4096", waves));
  std::vector<int> k_of, m_of;
  for (int k = 1; k <= waves; ++k)
    for (int m = 1; k * k + (m - 0.5) * (m - 0.5) <= 1.0 * waves * waves; ++m) {
      k_of.push_back(k);
      m_of.push_back(m);
    }
  if (k_of.empty()) k_of = m_of = {1};  // one wave: the first load alone
  k_ = Eigen::Map<Eigen::VectorXi>(k_of.data(), static_cast<Eigen::Index>(k_of.size()));
  m_ = Eigen::Map<Eigen::VectorXi>(m_of.data(), static_cast<Eigen::Index>(m_of.size()));
  response_ = (std::numbers::pi * std::numbers::pi *
               (k_.cast<double>().array().square() + (m_.cast<double>().array() - 0.5).square()))
                  .inverse();
}

double LoadModes::beyond() const { return 1 / (waves_ * std::numbers::pi); }

void LoadModes::check_size(const Eigen::VectorXd& f) const {
  if (f.size() != size())
    throw Error(fmt::format("loads: {} coefficients; accepted {}", f.size(), size()));
}

Eigen::VectorXd LoadModes::on_free_sigma(const Eigen::VectorXd& f) const {
  check_size(f);
  Eigen::VectorXd p = Eigen::VectorXd::Zero(waves_ + 1);
  for (int j = 0; j < size(); ++j) p(k_(j)) += response_(j) * f(j);
  return p;
}

Eigen::VectorXd LoadModes::taken_away(double epsilon) const {
  if (!(epsilon >= 0 && epsilon <= 1))
    throw Error(fmt::format("loads: epsilon = {}; accepted: 0 to 1", epsilon));
  Eigen::VectorXd share = Eigen::VectorXd::Zero(waves_ + 1);
  for (int k = 1; k <= waves_; ++k) {
    const Symbols symbols(k, epsilon);
    share(k) = symbols.layer / (symbols.body + symbols.layer);
  }
  return share;
}

Eigen::VectorXd LoadModes::response(const Eigen::VectorXd& f, double epsilon) const {
  Eigen::VectorXd pulled = taken_away(epsilon).cwiseProduct(on_free_sigma(f));
  for (int k = 1; k <= waves_; ++k) pulled(k) *= 2 * Symbols(k, epsilon).body;
  return response_.cwiseProduct(f - pulled(k_));
}

Eigen::VectorXd LoadModes::sines(double x) const {
  return (Eigen::ArrayXd::LinSpaced(waves_ + 1, 0, waves_) * (std::numbers::pi * x)).sin();
}

Eigen::VectorXd LoadModes::cosines(double y) const {
  return ((Eigen::ArrayXd::LinSpaced(waves_ + 1, 0, waves_) - 0.5) * (std::numbers::pi * y)).cos();
}

Eigen::VectorXd LoadModes::decays(double y) const {
  Eigen::VectorXd d = Eigen::VectorXd::Zero(waves_ + 1);
  for (int k = 1; k <= waves_; ++k) d(k) = decay(k * std::numbers::pi, y);
  return d;
}

double LoadModes::value(const Eigen::VectorXd& f, double x, double y) const {
  check_size(f);
  const Eigen::VectorXd sine = sines(x), cosine = cosines(y);
  double sum = 0;
  for (int j = 0; j < size(); ++j) sum += 2 * f(j) * sine(k_(j)) * cosine(m_(j));
  return sum;
}

Eigen::VectorXd LoadModes::wave(int k, int m) const {
  for (int j = 0; j < size(); ++j)
    if (k_(j) == k && m_(j) == m) return Eigen::VectorXd::Unit(size(), j);
  throw Error(
      fmt::format("loads: wave ({}, {}); accepted: k^2 + (m - 1/2)^2 up to {}^2", k, m, waves_));
}

Eigen::VectorXd LoadModes::constant_in_y(int k, double amplitude) const {
  if (k < 1 || k > waves_)
    throw Error(fmt::format("loads: sin({} pi x); accepted: 1 to {} pi", k, waves_));
  Eigen::VectorXd f = Eigen::VectorXd::Zero(size());
  for (int j = 0; j < size(); ++j)  // int_0^1 cos(mu y) dy = sin(mu) / mu, sin(mu_m) = -(-1)^m
    if (k_(j) == k)
      f(j) = amplitude * (m_(j) % 2 == 1 ? 1 : -1) / ((m_(j) - 0.5) * std::numbers::pi);
  return f;
}

}  // namespace antilock
