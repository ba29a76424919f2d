#include "antilock/certificate/balanced_tolerance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/certificate/certificate.hpp"
#include "antilock/core/error.hpp"
#include "antilock/models/anti_plane.hpp"

namespace antilock {

EnergyBounds energy_bounds(const Scene& scene, const TriangleMesh& mesh) {
  require_triangles(mesh, "energy bounds");
  const Space conforming(mesh, p1()), nonconforming(conforming, crouzeix_raviart());
  Result result{nonconforming, assemble(scene, nonconforming)};
  result.solution = active_set(result.problem);
  const ConformingCompanion v = p1_companion(active_set(assemble_in_k(scene, conforming)));
  const Certificate found = certify(scene, result, {.companion = &v});
  return {.lower = found.energy_lower, .upper = found.energy_upper};
}

AlgebraicTolerance balanced_tolerance(const EnergyBounds& bracket, double coarser, double share) {
  if (!(coarser >= 1 && std::isfinite(coarser) && share > 0 && share <= 1))
    throw Error(fmt::format(
        "accurate enough: {} times as coarse, a share of {}; accepted: 1 or more, above 0 up to 1",
        coarser, share));
  const double scale = std::max(std::abs(bracket.upper), std::abs(bracket.lower));
  if (!(bracket.width() > 0)) return {};
  const double relative = share * bracket.width() / (coarser * coarser) / scale;
  return {relative * relative * scale, relative};
}

}  // namespace antilock
