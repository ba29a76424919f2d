#pragma once
#include <numbers>
#include <utility>
#include <vector>

namespace antilock {

// The problem across the layer for one wave of the number a, in closed form. In the plane the wave
// is sin(k pi x), a = k pi. In space it is sin(k pi x) sin(l pi y), a = pi (k^2 + l^2)^(1/2), and y
// below stands for z. Sigma is the interface y = 0 of body and layer, Gamma_C the contact boundary
// y = -1.

/// The solution in the body under a load f_k(y) in one wave, f_k a polynomial, with u = 0 at y = 0
/// and y = 1: u = G(y) in this wave with -G'' + a^2 G = f_k, G(0) = G(1) = 0. The closed form does
/// not overflow for any a.
class WaveResponse {
 public:
  /// `profile` gives f_k(y) = profile[0] + profile[1] y + ..., of degree at most max_degree.
  WaveResponse(double a, std::vector<double> profile);
  /// Above this degree the closed form loses more than three digits by cancellation at a = pi.
  static constexpr int max_degree = 12;

  double a() const { return a_; }
  double force(double y) const;          ///< f_k(y)
  double value(double y) const;          ///< G(y)
  double slope(double y) const;          ///< G'(y)
  double pull() const { return pull_; }  ///< G'(0) = int f_k sinh(a(1-y)) / sinh(a) dy
  double work() const { return work_; }  ///< int f_k G dy

 private:
  double a_;
  std::vector<double> force_, particular_;  // f_k and P, by powers of y
  double pull_, work_;
};

/// The same for the wave sin(k pi x).
class LoadResponse : public WaveResponse {
 public:
  LoadResponse(int k, std::vector<double> profile)
      : WaveResponse(k * std::numbers::pi, std::move(profile)), k_(k) {}
  int k() const { return k_; }

 private:
  int k_;
};

/// Return sinh(a(1-y)) / sinh(a), and -1/a times its derivative, 0 <= y <= 1, by decaying
/// exponentials.
double decay(double a, double y);
double decay_slope(double a, double y);

/// The response of body and layer on Gamma_C in a wave, by the formulas of transmission lines.
/// Every member is finite for every 0 <= epsilon <= 1, 0 included. wave.cpp has the derivation.
struct Symbols {
  Symbols(double a, double epsilon);
  /// Makes the response for the wave sin(k pi x), a = k pi.
  Symbols(int k, double epsilon) : Symbols(k * std::numbers::pi, epsilon) {}
  double a;     ///< the number of the wave
  double body;  ///< T = a coth a: the pull of the body on Sigma is G'(0) - T w
  /// R = a tanh(kappa) / epsilon, kappa = epsilon a: the pull on Sigma of a layer that is free on
  /// Gamma_C is R w.
  double layer;
  double stiffness;  ///< D_k: lambda_k = D_k c_k - q_k
  /// w_k = trace c_k + lift G'(0): u on Sigma from u on Gamma_C and the load; q_k = trace G'(0).
  double trace;
  double lift;  ///< (see trace)
};

/// Returns polynomial[0] + polynomial[1] y + ...
double evaluate(const std::vector<double>& polynomial, double y);

}  // namespace antilock
