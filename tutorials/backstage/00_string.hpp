#pragma once
// The exact string of chapter 00, load 10 sin(2 pi x), and where a discrete one touches.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace antilock::tutorial {

/// Where the exact string comes to lie on a floor at -depth (0 to 0.2): the zero of sin z - z cos z + depth / alpha.
inline double touches_from(double depth) {
  using std::numbers::pi;
  const auto f = [=](double z) { return std::sin(z) - z * std::cos(z) + depth * 4 * pi * pi / 10; };
  double low = 4, high = 6;
  for (int i = 0; i < 60; ++i) (f(low) * f((low + high) / 2) <= 0 ? high : low) = (low + high) / 2;
  return low / (2 * pi);
}

/// The first x_i = i / (n + 1) with a force; 1 without one.
inline double contact_starts(const Eigen::VectorXd& lambda) {
  const auto pushed = std::find_if(lambda.begin(), lambda.end(), [](double force) { return force > 0; });
  return static_cast<double>(pushed - lambda.begin() + 1) / static_cast<double>(lambda.size() + 1);
}

/// Its free part on a floor at 0: alpha sin(2 pi x) + s x, U of the page.
inline double free_part(double x) {
  using std::numbers::pi;
  return 10 / (4 * pi * pi) * (std::sin(2 * pi * x) - 2 * pi * x * std::cos(2 * pi * touches_from(0)));
}

/// The discrete string of so many cells that touches from the node `from` on, at its inner nodes: what the page derives.
inline Eigen::VectorXd discrete_string(int cells, double from) {
  Eigen::VectorXd u(cells - 1);
  for (int i = 1; i < cells; ++i) {
    const double x = i / static_cast<double>(cells);
    u(i - 1) = x < from ? free_part(x) - free_part(from) * x / from : 0;
  }
  return u;
}
/// The exact string at the same nodes: there nothing is to be taken off, since U is 0 where contact starts.
inline Eigen::VectorXd exact_string(int cells) { return discrete_string(cells, touches_from(0)); }

}  // namespace antilock::tutorial
