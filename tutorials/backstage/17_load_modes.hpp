#pragma once
#include <fmt/format.h>
#include <Eigen/Core>

#include <cmath>
#include <numbers>
#include <vector>

#include "antilock/core/detail/eigen_memory.hpp"
#include "antilock/core/error.hpp"
#include "antilock/exact/detail/wave.hpp"

namespace antilock::tutorial {

/// The loads 2 sin(k pi x) cos(mu_m y), mu_m = (m - 1/2) pi, k, m >= 1, on the body and 0 on the layer: an orthonormal
/// basis of L2(body), cut where k^2 + (m - 1/2)^2 > waves^2. A load is the vector of its n coefficients, its L2 norm
/// that of the vector.
///
/// And what the exact problem (23) without contact does with them, in closed form (derivation below).
class LoadModes {
 public:
  /// Throws Error unless 1 <= waves <= 4096. Below, for a load of another number of coefficients than n, and for an
  /// epsilon outside 0 to 1.
  explicit LoadModes(int waves);

  int waves() const { return waves_; }
  int size() const { return static_cast<int>(k_.size()); }          ///< n
  const Eigen::VectorXi& k() const { return k_; }                   ///< n, ascending
  const Eigen::VectorXi& m() const { return m_; }                   ///< n
  const Eigen::VectorXd& held_at_top() const { return response_; }  ///< n: g = 1 / ((k pi)^2 + mu_m^2)
  /// A load that is left out, of norm 1, has an energy norm of at most this: 1 / (waves pi).
  double beyond() const;

  /// By k = 1 .. waves (0 unused): sum of g f, the displacement on Sigma of a body that is free there.
  Eigen::VectorXd on_free_sigma(const Eigen::VectorXd& f) const;
  /// By k: R / (T + R), the share of it that the layer takes away; T, R: stiffness of body and layer on Sigma.
  Eigen::VectorXd taken_away(double epsilon) const;
  /// n coefficients of S f: (S f, v) = (u, v) on the body for each load v, u the solution for f.
  Eigen::VectorXd response(const Eigen::VectorXd& f, double epsilon) const;

  /// (waves + 1) values of sin(k pi x), of cos(mu_m y), of decay(k pi, y).
  Eigen::VectorXd sines(double x) const;
  Eigen::VectorXd cosines(double y) const;
  Eigen::VectorXd decays(double y) const;
  /// The load f at a point of the body.
  double value(const Eigen::VectorXd& f, double x, double y) const;
  /// The basis load 2 sin(k pi x) cos(mu_m y). Throws Error where it is cut.
  Eigen::VectorXd wave(int k, int m) const;
  /// The coefficients of amplitude sin(k pi x): a load that does not depend on y. Throws Error unless 1 <= k <= waves.
  Eigen::VectorXd constant_in_y(int k, double amplitude) const;

 private:
  void check_size(const Eigen::VectorXd& f) const;
  int waves_;
  Eigen::VectorXi k_, m_;
  Eigen::VectorXd response_;
};

// In the body free on Sigma (u_y = 0 there) the load 2 sin(a x) cos(mu y) gives itself times g = 1 / (a^2 + mu^2): the
// basis diagonalises that problem. Let P_k = sum_m g_km f_km be its u on Sigma. The layer pulls there with R w, the
// body gives way by w = P - R w / T, hence w = P T / (T + R), and
//     u = sum_k 2 sin(a x) (sum_m g_km f_km cos(mu_m y) - P_k R / (T + R) decay(a, y)),
// since decay(a, 0) = 1 and -decay'(a, 0) = T. With int cos(mu_m y) decay(a, y) dy = T g_km (by parts, twice):
//     S f = g f - 2 T R / (T + R) P_k g,    per k a diagonal matrix less one of rank one.
inline LoadModes::LoadModes(int waves) : waves_(waves) {
  if (waves < 1 || waves > 4096) throw Error(fmt::format("loads: {} waves; accepted: 1 to 4096", waves));
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

inline double LoadModes::beyond() const { return 1 / (waves_ * std::numbers::pi); }

inline void LoadModes::check_size(const Eigen::VectorXd& f) const {
  if (f.size() != size()) throw Error(fmt::format("loads: {} coefficients; accepted {}", f.size(), size()));
}

inline Eigen::VectorXd LoadModes::on_free_sigma(const Eigen::VectorXd& f) const {
  check_size(f);
  Eigen::VectorXd p = Eigen::VectorXd::Zero(waves_ + 1);
  for (int j = 0; j < size(); ++j) p(k_(j)) += response_(j) * f(j);
  return p;
}

inline Eigen::VectorXd LoadModes::taken_away(double epsilon) const {
  if (!(epsilon >= 0 && epsilon <= 1)) throw Error(fmt::format("loads: epsilon = {}; accepted: 0 to 1", epsilon));
  Eigen::VectorXd share = Eigen::VectorXd::Zero(waves_ + 1);
  for (int k = 1; k <= waves_; ++k) {
    const Symbols symbols(k, epsilon);
    share(k) = symbols.layer / (symbols.body + symbols.layer);
  }
  return share;
}

inline Eigen::VectorXd LoadModes::response(const Eigen::VectorXd& f, double epsilon) const {
  Eigen::VectorXd pulled = taken_away(epsilon).cwiseProduct(on_free_sigma(f));
  for (int k = 1; k <= waves_; ++k) pulled(k) *= 2 * Symbols(k, epsilon).body;
  return response_.cwiseProduct(f - pulled(k_));
}

inline Eigen::VectorXd LoadModes::sines(double x) const {
  return (Eigen::ArrayXd::LinSpaced(waves_ + 1, 0, waves_) * (std::numbers::pi * x)).sin();
}
inline Eigen::VectorXd LoadModes::cosines(double y) const {
  return ((Eigen::ArrayXd::LinSpaced(waves_ + 1, 0, waves_) - 0.5) * (std::numbers::pi * y)).cos();
}
inline Eigen::VectorXd LoadModes::decays(double y) const {
  Eigen::VectorXd d = Eigen::VectorXd::Zero(waves_ + 1);
  for (int k = 1; k <= waves_; ++k) d(k) = decay(k * std::numbers::pi, y);
  return d;
}

inline double LoadModes::value(const Eigen::VectorXd& f, double x, double y) const {
  check_size(f);
  const Eigen::VectorXd sine = sines(x), cosine = cosines(y);
  double sum = 0;
  for (int j = 0; j < size(); ++j) sum += 2 * f(j) * sine(k_(j)) * cosine(m_(j));
  return sum;
}

inline Eigen::VectorXd LoadModes::wave(int k, int m) const {
  for (int j = 0; j < size(); ++j)
    if (k_(j) == k && m_(j) == m) return Eigen::VectorXd::Unit(size(), j);
  throw Error(fmt::format("loads: wave ({}, {}); accepted: k^2 + (m - 1/2)^2 up to {}^2", k, m, waves_));
}

inline Eigen::VectorXd LoadModes::constant_in_y(int k, double amplitude) const {
  if (k < 1 || k > waves_) throw Error(fmt::format("loads: sin({} pi x); accepted: 1 to {} pi", k, waves_));
  Eigen::VectorXd f = Eigen::VectorXd::Zero(size());
  for (int j = 0; j < size(); ++j)  // int_0^1 cos(mu y) dy = sin(mu) / mu, sin(mu_m) = -(-1)^m
    if (k_(j) == k) f(j) = amplitude * (m_(j) % 2 == 1 ? 1 : -1) / ((m_(j) - 0.5) * std::numbers::pi);
  return f;
}

}  // namespace antilock::tutorial
