#pragma once
#include <Eigen/Core>
#include <cmath>

namespace antilock {

/// Estimate of the largest eigenvalue of a symmetric positive definite operator on R^size, from below, to about 1e-3:
/// enough to choose a step length. Starts from a fixed vector with every frequency in it.
template <class Operator>
double largest_eigenvalue(Operator&& apply, Eigen::Index size, int max_steps = 200, double tolerance = 1e-4) {
  Eigen::VectorXd x(size);
  for (Eigen::Index i = 0; i < size; ++i) x(i) = 1 + 0.5 * std::sin(1.7 * static_cast<double>(i * i));
  x.normalize();
  double value = 0;
  for (int step = 0; step < max_steps; ++step) {
    const Eigen::VectorXd y = apply(x);
    const double next = x.dot(y);
    x = y.normalized();
    if (step > 3 && std::abs(next - value) <= tolerance * next) return next;
    value = next;
  }
  return value;
}

}  // namespace antilock
