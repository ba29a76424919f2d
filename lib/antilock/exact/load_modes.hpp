#pragma once
#include <Eigen/Core>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

/// The loads 2 sin(k pi x) cos(mu_m y), mu_m = (m - 1/2) pi, k, m >= 1, on the body and 0 on the layer: an orthonormal
/// basis of L2(body), cut where k^2 + (m - 1/2)^2 > waves^2. A load is the vector of its n coefficients, its L2 norm
/// that of the vector.
///
/// And what the exact problem (23) without contact does with them, in closed form (derivation in load_modes.cpp).
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

}  // namespace antilock
