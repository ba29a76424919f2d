#include "antilock/exact/wave.hpp"

#include <cmath>
#include <numeric>

namespace antilock {
namespace {

using Polynomial = std::vector<double>;

double evaluate_slope(const Polynomial& p, double y) {
  double sum = 0;
  for (std::size_t m = p.size(); m-- > 1;) sum = sum * y + double(m) * p[m];
  return sum;
}

double integral_of_product(const Polynomial& p, const Polynomial& q) {
  double sum = 0;
  for (std::size_t m = 0; m < p.size(); ++m)
    for (std::size_t n = 0; n < q.size(); ++n) sum += p[m] * q[n] / double(m + n + 1);
  return sum;
}

// -P'' + a^2 P = f, by powers of y: P_m = (f_m + (m+2)(m+1) P_{m+2}) / a^2, from the highest power
// down.
Polynomial particular_solution(const Polynomial& f, double a) {
  Polynomial p(f.size());
  for (std::size_t m = f.size(); m-- > 0;) {
    const double above = m + 2 < f.size() ? double((m + 2) * (m + 1)) * p[m + 2] : 0;
    p[m] = (f[m] + above) / (a * a);
  }
  return p;
}

}  // namespace

double evaluate(const Polynomial& p, double y) {
  return std::accumulate(p.rbegin(), p.rend(), 0.0,
                         [y](double sum, double c) { return sum * y + c; });
}

double decay(double a, double y) {
  return std::exp(-a * y) * std::expm1(-2 * a * (1 - y)) / std::expm1(-2 * a);
}

double decay_slope(double a, double y) {
  return std::exp(-a * y) * (1 + std::exp(-2 * a * (1 - y))) / -std::expm1(-2 * a);
}

// G = P - P(0) S(y) - P(1) S(1-y) with S(y) = sinh(a(1-y)) / sinh(a), which solves -S'' + a^2 S =
// 0, S(0) = 1, S(1) =
// 0. Multiply -G'' + a^2 G = f_k by S and integrate by parts twice: int f_k S = G'(0); by S(1-y):
//    int f_k S(1-y) =
// -G'(1). Hence int f_k G = int f_k P - P(0) G'(0) + P(1) G'(1).
WaveResponse::WaveResponse(double a, Polynomial profile)
    : a_(a), force_(std::move(profile)), particular_(particular_solution(force_, a_)) {
  pull_ = slope(0);
  work_ = integral_of_product(force_, particular_) - evaluate(particular_, 0) * slope(0) +
          evaluate(particular_, 1) * slope(1);
}

double WaveResponse::force(double y) const { return evaluate(force_, y); }

double WaveResponse::value(double y) const {
  return evaluate(particular_, y) - evaluate(particular_, 0) * decay(a_, y) -
         evaluate(particular_, 1) * decay(a_, 1 - y);
}

double WaveResponse::slope(double y) const {
  return evaluate_slope(particular_, y) + a_ * evaluate(particular_, 0) * decay_slope(a_, y) -
         a_ * evaluate(particular_, 1) * decay_slope(a_, 1 - y);
}

// In the layer u_xx + epsilon^-2 u_yy = 0, so with kappa = epsilon a, z = a / epsilon, eta = 1 + y:
//   u = c cosh(kappa eta) - (lambda / z) sinh(kappa eta),   stress p = epsilon^-2 u_y,
//     p = -lambda on Gamma_C
// (the outward normal is -y, and the obstacle pushes up with lambda). On Sigma, eta = 1, the
// displacement w and the stress must be the body's, p = G'(0) - T w. Two equations for w and
// lambda, given c:
//   w = c cosh kappa - (lambda / z) sinh kappa,     z c sinh kappa - lambda cosh kappa = G'(0) - T
//   w
// hence, with mu = (T / z) tanh kappa = epsilon coth(a) tanh(kappa),
//   lambda = (T + a^2 tanh(kappa)/kappa) / (1 + mu) c  -  G'(0) / (cosh kappa (1 + mu))
//   w      = c / (cosh kappa (1 + mu))                 +  G'(0) (epsilon / a) tanh(kappa) / (1 +
//   mu).
// Written so, nothing divides by epsilon: at 0, lambda = (T + a^2) c - G'(0), the Ventcel symbol of
// (25), and w = c.
Symbols::Symbols(double wave, double epsilon) : a(wave), body(a / std::tanh(a)) {
  const double kappa = epsilon * a;
  const double tanh_kappa = std::tanh(kappa);
  const double one_plus_mu = 1 + epsilon * tanh_kappa / std::tanh(a);
  layer = a * a * (kappa > 0 ? tanh_kappa / kappa : 1);
  stiffness = (body + layer) / one_plus_mu;
  trace = 1 / (std::cosh(kappa) * one_plus_mu);
  lift = epsilon / a * tanh_kappa / one_plus_mu;
}

}  // namespace antilock
