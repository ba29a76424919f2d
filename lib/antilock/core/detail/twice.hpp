#pragma once
#include <Eigen/Core>
#include <cmath>

#include "antilock/core/detail/eigen_memory.hpp"

namespace antilock {

/// x = high + low, |low| <= eps |high| / 2: numbers of 106 bits, by operations on doubles whose own rounding error is
/// found exactly. T. J. Dekker, Numer. Math. 18 (1971); N. J. Higham, Accuracy and Stability, section 27.9.
struct Two {
  double high = 0, low = 0;
};
inline Two two_sum(double a, double b) {
  const double sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}
inline Two two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}
inline Two operator+(Two a, Two b) {
  const Two sum = two_sum(a.high, b.high);
  const double low = sum.low + (a.low + b.low), high = sum.high + low;
  return {high, low - (high - sum.high)};
}
inline Two operator*(double a, Two b) {
  Two product = two_product(a, b.high);
  product.low += a * b.low;
  return product;
}

/// A vector of such numbers.
struct Twice {
  Eigen::VectorXd high, low;

  Twice() = default;
  Twice(Eigen::VectorXd x) : high(std::move(x)), low(Eigen::VectorXd::Zero(high.size())) {}
  Eigen::Index size() const { return high.size(); }
  Two operator()(Eigen::Index i) const { return {high(i), low(i)}; }
  void set(Eigen::Index i, double x) { high(i) = x, low(i) = 0; }
  void add(Eigen::Index i, Two x) {
    const Two sum = (*this)(i) + x;
    high(i) = sum.high, low(i) = sum.low;
  }
  Twice& operator+=(const Eigen::VectorXd& x) {
    for (Eigen::Index i = 0; i < size(); ++i) add(i, {x(i), 0});
    return *this;
  }
  /// Rounded once, however close the two are.
  Eigen::VectorXd operator-(const Twice& other) const {
    Eigen::VectorXd difference(size());
    for (Eigen::Index i = 0; i < size(); ++i) difference(i) = ((*this)(i) + Two{-other.high(i), -other.low(i)}).high;
    return difference;
  }
};

}  // namespace antilock
