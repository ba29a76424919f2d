#pragma once
#include <vector>

namespace antilock {

/// What the body does under the load f_k(y) sin(k pi x), f_k a polynomial, while both y = 0 and y = 1 are held:
/// u = G(y) sin(k pi x) with -G'' + a^2 G = f_k, G(0) = G(1) = 0, a = k pi. Closed form, safe for every k.
class LoadResponse {
 public:
  /// profile: f_k(y) = profile[0] + profile[1] y + ..., degree at most max_degree.
  LoadResponse(int k, std::vector<double> profile);
  /// Beyond it the closed form loses more than three digits by cancellation at k = 1.
  static constexpr int max_degree = 12;

  int k() const { return k_; }
  double force(double y) const;          ///< f_k(y)
  double value(double y) const;          ///< G(y)
  double slope(double y) const;          ///< G'(y)
  double pull() const { return pull_; }  ///< G'(0) = int f_k sinh(a(1-y)) / sinh(a) dy
  double work() const { return work_; }  ///< int f_k G dy

 private:
  int k_;
  double a_;
  std::vector<double> force_, particular_;  // f_k and P, by powers of y
  double pull_, work_;
};

/// sinh(a(1-y)) / sinh(a) and -1/a times its derivative, 0 <= y <= 1, by decaying exponentials.
double decay(double a, double y);
double decay_slope(double a, double y);

}  // namespace antilock
