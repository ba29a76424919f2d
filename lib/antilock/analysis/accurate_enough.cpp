// The lower bound, by duality, in the notation of certificate.cpp. For every v of K
//
//     J(v) = D + m^2 / 2 + C - (f - f_1, v) + R(v),   m = |A grad v - sigma|,   C >= 0.
//
// u_h is affine on each triangle, so (f - f_1, v) = (f - f_1, v - u_h) <= osc x with x = |A grad v - S_h|, and
// x <= m + |tau|. The forces that an early stop leaves: R(v) = r1' u_h + r1' (I_h v - u_h), the second part at most
// rho |I_h v - u_h|_K in the norm of K = A1 + delta^-1 B' M B; its stiff part is no larger than that of x but for the
// strain r2 = epsilon^2 p - B u_h, which costs |r2|_M / delta^(1/2) more. With q = osc + rho, the smallest value of
// m^2 / 2 - q m is -q^2 / 2:
//
//     J(u) >= D + r1' u_h - rho |r2|_M / delta^(1/2) - q^2 / 2 - q |tau|.
//
// With f affine on triangles, after a direct solve and without a gap, that is -1/2 |sigma|^2.
#include "antilock/analysis/accurate_enough.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/analysis/certificate.hpp"
#include "antilock/core/error.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/models/anti_plane.hpp"

namespace antilock {

double energy_lower_bound(const Scene& scene, const Space& space, const VariationalInequality& problem,
                          const Solution& solution) {
  const EquilibratedFlux flux = equilibrated_flux(scene, space, problem, solution);
  PenaltyFactor factor(problem);
  const double rho = unbalanced(problem, flux, &factor), q = std::sqrt(flux.oscillation2) + rho;
  double strain2 = 0;  // |r2|_M^2
  if (problem.b.rows() > 0)
    strain2 = (problem.compliance * solution.p - problem.b * solution.u).cwiseAbs2().dot(problem.m);
  return flux.dual + flux.imbalance.dot(solution.u) - rho * std::sqrt(strain2 / factor.delta()) - q * q / 2 -
         q * std::sqrt(flux.tau2);
}

EnergyBracket energy_bracket(const Scene& scene, const TriangleMesh& mesh) {
  const Space conforming(mesh, p1()), nonconforming(mesh, crouzeix_raviart());
  VariationalInequality above = assemble(scene, conforming);
  if (scene.contact()) above.lower = admissible_bounds(*scene.contact(), conforming);  // in K between the vertices, too
  const VariationalInequality below = assemble(scene, nonconforming);
  return {.lower = energy_lower_bound(scene, nonconforming, below, active_set(below)),
          .upper = energy(above, active_set(above))};
}

AccurateEnough accurate_enough(const EnergyBracket& bracket, double coarser, double share) {
  if (!(coarser >= 1 && std::isfinite(coarser) && share > 0 && share <= 1))
    throw Error(fmt::format("accurate enough: {} times as coarse, a share of {}; accepted: 1 or more, above 0 up to 1",
                            coarser, share));
  const double scale = std::max(std::abs(bracket.upper), std::abs(bracket.lower));
  if (!(bracket.width() > 0)) return {};
  const double relative = share * bracket.width() / (coarser * coarser) / scale;
  return {relative * relative * scale, relative};
}

}  // namespace antilock
