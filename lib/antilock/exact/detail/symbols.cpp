#include "antilock/exact/detail/symbols.hpp"

#include <cmath>
#include <numbers>

namespace antilock {

// In the layer u_xx + epsilon^-2 u_yy = 0, so with kappa = epsilon a, z = a / epsilon, eta = 1 + y:
//   u = c cosh(kappa eta) - (lambda / z) sinh(kappa eta),   stress p = epsilon^-2 u_y,   p = -lambda on Gamma_C
// (the outward normal is -y, and the obstacle pushes up with lambda). On Sigma, eta = 1, the displacement w and the
// stress must be the body's, p = G'(0) - T w. Two equations for w and lambda, given c:
//   w = c cosh kappa - (lambda / z) sinh kappa,     z c sinh kappa - lambda cosh kappa = G'(0) - T w
// hence, with mu = (T / z) tanh kappa = epsilon coth(a) tanh(kappa),
//   lambda = (T + a^2 tanh(kappa)/kappa) / (1 + mu) c  -  G'(0) / (cosh kappa (1 + mu))
//   w      = c / (cosh kappa (1 + mu))                 +  G'(0) (epsilon / a) tanh(kappa) / (1 + mu).
// Written so, nothing divides by epsilon: at 0, lambda = (T + a^2) c - G'(0), the Ventcel symbol of (25), and w = c.
Symbols::Symbols(int k, double epsilon) : a(k * std::numbers::pi), body(a / std::tanh(a)) {
  const double kappa = epsilon * a;
  const double tanh_kappa = std::tanh(kappa);
  const double tanh_over_kappa = kappa > 0 ? tanh_kappa / kappa : 1;
  const double one_plus_mu = 1 + epsilon * tanh_kappa / std::tanh(a);
  stiffness = (body + a * a * tanh_over_kappa) / one_plus_mu;
  load = trace = 1 / (std::cosh(kappa) * one_plus_mu);
  lift = epsilon / a * tanh_kappa / one_plus_mu;
}

}  // namespace antilock
