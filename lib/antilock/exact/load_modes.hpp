#pragma once
#include <Eigen/Core>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

/// The loads 2 sin(k pi x) cos(mu_m y), mu_m = (m - 1/2) pi, k, m >= 1, on the body and 0 on the
/// layer. They are an orthonormal basis of L2(body). It is cut where k^2 + (m - 1/2)^2 > waves^2. A
/// load is the vector of its n coefficients, and its L2 norm is that of the vector.
///
/// The class also has the exact solution of (23) of [SR04] (cited in
/// problem/variational_inequality.hpp) without contact for these loads, in closed form (derivation
/// in load_modes.cpp). Sigma is the interface of body and layer.
class LoadModes {
 public:
  /// Throws Error unless 1 <= waves <= 4096. The functions below throw Error for a load without n
  /// coefficients, and for an epsilon outside of [0, 1].
  explicit LoadModes(int waves);

  int waves() const { return waves_; }
  int size() const { return static_cast<int>(k_.size()); }  ///< n
  const Eigen::VectorXi& k() const { return k_; }           ///< n, ascending
  const Eigen::VectorXi& m() const { return m_; }           ///< n
  /// Returns n values, g = 1 / ((k pi)^2 + mu_m^2) of each mode.
  const Eigen::VectorXd& held_at_top() const { return response_; }
  /// Returns 1 / (waves pi). The solution for a load of norm 1 that is orthogonal to the basis has
  /// at most this energy norm.
  double beyond() const;

  /// Returns for k = 1 .. waves (0 unused) the sum of g f over m, the displacement on Sigma of a
  /// body that is free there.
  Eigen::VectorXd on_free_sigma(const Eigen::VectorXd& f) const;
  /// Returns for each k the fraction R / (T + R) by which the layer reduces this displacement. T
  /// and R are the stiffnesses of body and layer on Sigma (exact/wave.hpp).
  Eigen::VectorXd taken_away(double epsilon) const;
  /// Returns the n coefficients of S f, defined by (S f, v) = (u, v) on the body for each load v,
  /// with u the solution for f.
  Eigen::VectorXd response(const Eigen::VectorXd& f, double epsilon) const;

  /// Each returns (waves + 1) values: sin(k pi x), cos(mu_m y) and decay(k pi, y).
  Eigen::VectorXd sines(double x) const;
  Eigen::VectorXd cosines(double y) const;
  Eigen::VectorXd decays(double y) const;
  /// Returns the load f at a point of the body.
  double value(const Eigen::VectorXd& f, double x, double y) const;
  /// Returns the basis load 2 sin(k pi x) cos(mu_m y). Throws Error if it is not in the basis.
  Eigen::VectorXd wave(int k, int m) const;
  /// Returns the coefficients of the load amplitude sin(k pi x), which does not depend on y. Throws
  /// Error unless 1 <= k <= waves.
  Eigen::VectorXd constant_in_y(int k, double amplitude) const;

 private:
  void check_size(const Eigen::VectorXd& f) const;
  int waves_;
  Eigen::VectorXi k_, m_;
  Eigen::VectorXd response_;
};

}  // namespace antilock
