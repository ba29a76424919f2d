#pragma once
#include <Eigen/Core>
#include <cmath>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

/// A number x = high + low of 106 bits, |low| <= eps |high| / 2. Its operations use doubles, and
/// sums and products of two doubles are computed with their exact rounding errors. T. J. Dekker,
/// Numer. Math. 18 (1971); N. J. Higham, Accuracy and Stability, section 27.9.
struct DoubleDouble {
  double high = 0, low = 0;
};
inline DoubleDouble two_sum(double a, double b) {
  const double sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}
inline DoubleDouble two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}
inline DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble sum = two_sum(a.high, b.high);
  const double low = sum.low + (a.low + b.low), high = sum.high + low;
  return {high, low - (high - sum.high)};
}
inline DoubleDouble operator*(double a, DoubleDouble b) {
  DoubleDouble product = two_product(a, b.high);
  product.low += a * b.low;
  return product;
}

/// A vector of such numbers.
struct DoubleDoubleVector {
  Eigen::VectorXd high, low;

  DoubleDoubleVector() = default;
  DoubleDoubleVector(Eigen::VectorXd x)
      : high(std::move(x)), low(Eigen::VectorXd::Zero(high.size())) {}
  Eigen::Index size() const { return high.size(); }
  DoubleDouble operator()(Eigen::Index i) const { return {high(i), low(i)}; }
  void set(Eigen::Index i, double x) {
    high(i) = x;
    low(i) = 0;
  }
  void add(Eigen::Index i, DoubleDouble x) {
    const DoubleDouble sum = (*this)(i) + x;
    high(i) = sum.high;
    low(i) = sum.low;
  }
  DoubleDoubleVector& operator+=(const Eigen::VectorXd& x) {
    for (Eigen::Index i = 0; i < size(); ++i) add(i, {x(i), 0});
    return *this;
  }
  /// Returns the difference, rounded once: there is no cancellation error even if both are nearly
  /// equal.
  Eigen::VectorXd operator-(const DoubleDoubleVector& other) const {
    Eigen::VectorXd difference(size());
    for (Eigen::Index i = 0; i < size(); ++i)
      difference(i) = ((*this)(i) + DoubleDouble{-other.high(i), -other.low(i)}).high;
    return difference;
  }
};

}  // namespace antilock
