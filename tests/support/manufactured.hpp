#pragma once
#include <cmath>
#include <numbers>

#include "antilock/measure/errors.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock::test {

/// Exact solutions without contact, u = sin(pi x) g(y) with
///   body   g = (1 - y) (c + b y):                clamped at y = 1; f = (pi^2 g + 2 b) sin(pi x)
///   layer  g = cosh(epsilon pi (y + 1)):         - u_xx - epsilon^-2 u_yy = 0 and free at y = -1,
///   (23)
/// c from continuity on Sigma, b from the balance of forces there.
struct Manufactured {
  double b, c, epsilon;

  /// Laplace on the body alone, free on y = 0: g'(0) = b - c = 0.
  static Manufactured no_layer() { return {1, 1, 0}; }
  /// (25): g'(0) = pi^2 g(0).
  static Manufactured ventcel() { return {1 + pi * pi, 1, 0}; }
  /// (23): g(0+) = cosh(epsilon pi), g'(0+) = pi sinh(epsilon pi) / epsilon; at epsilon = 0 its
  /// limit (24).
  static Manufactured stiff_layer(double epsilon) {
    const double c = std::cosh(epsilon * pi);
    return {c + (epsilon > 0 ? pi * std::sinh(epsilon * pi) / epsilon : pi * pi), c, epsilon};
  }

  double value(double x, double y) const { return std::sin(pi * x) * g(y); }
  Eigen::Vector2d gradient(double x, double y) const {
    const double slope =
        y >= 0 ? b - c - 2 * b * y : epsilon * pi * std::sinh(epsilon * pi * (y + 1));
    return {pi * std::cos(pi * x) * g(y), std::sin(pi * x) * slope};
  }
  double layer_stress(double x, double y) const {
    return std::sin(pi * x) *
           (epsilon > 0 ? pi * std::sinh(epsilon * pi * (y + 1)) / epsilon : pi * pi * (y + 1));
  }
  Field load() const {
    return [*this](double x, double y) { return (pi * pi * g(y) + 2 * b) * std::sin(pi * x); };
  }
  Reference reference() const {
    return {[*this](double x, double y) { return value(x, y); },
            [*this](double x, double y) { return gradient(x, y); },
            [*this](double x, double y) { return layer_stress(x, y); }};
  }

 private:
  static constexpr double pi = std::numbers::pi;
  double g(double y) const {
    return y >= 0 ? (1 - y) * (c + b * y) : std::cosh(epsilon * pi * (y + 1));
  }
};

}  // namespace antilock::test
