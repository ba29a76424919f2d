// The lower bound, by duality, in the notation of certificate.cpp. For every v of K
//
//     J(v) = D + m^2 / 2 + C - (f - f_1, v) + R(v),   m = |A grad v - sigma|,   C >= 0.
//
// u_h is affine on each triangle, so (f - f_1, v) = (f - f_1, v - u_h) <= osc x with x = |A grad v - S_h|, and
// x <= m + |tau|. The forces that an early stop leaves: R(v) = r1' u_h + r1' (I_h v - u_h), whose second part is at most
// rho |I_h v - u_h|_K in the norm of K = A1 + delta^-1 B' M B; its stiff part is no larger than that of x but for the
// strain r2 = epsilon^2 p - B u_h, which costs |r2|_M / delta^(1/2) more. With q = osc + rho, the smallest value of
// m^2 / 2 - q m is -q^2 / 2:
//
//     J(u) >= D + r1' u_h - rho |r2|_M / delta^(1/2) - q^2 / 2 - q |tau|.
//
// With f affine on triangles, after a direct solve and without a gap, that is -1/2 |sigma|^2.
#include "antilock/analysis/detail/energy_bracket.hpp"

#include <cmath>
#include <optional>

#include "antilock/analysis/certificate.hpp"

namespace antilock {

double energy_lower_bound(const Scene& scene, const Space& space, const VariationalInequality& problem,
                          const Solution& solution, PenaltyFactor* factor) {
  const EquilibratedFlux flux = equilibrated_flux(scene, space, problem, solution);
  std::optional<PenaltyFactor> own;
  if (factor == nullptr) factor = &own.emplace(problem);
  const double rho = unbalanced(problem, flux, factor), q = std::sqrt(flux.oscillation2) + rho;
  double strain2 = 0;  // |r2|_M^2
  if (problem.b.rows() > 0)
    strain2 = (problem.compliance * solution.p - problem.b * solution.u).cwiseAbs2().dot(problem.m);
  return flux.dual + flux.imbalance.dot(solution.u) - rho * std::sqrt(strain2 / factor->delta()) - q * q / 2 -
         q * std::sqrt(flux.tau2);
}

}  // namespace antilock
