#include "antilock/analysis/accurate_enough.hpp"

#include <algorithm>
#include <cmath>

#include "antilock/measure/errors.hpp"
#include "antilock/models/anti_plane.hpp"

namespace antilock {

EnergyBracket energy_bracket(const Scene& scene, const TriangleMesh& mesh) {
  const Space conforming(mesh, p1()), nonconforming(mesh, crouzeix_raviart());
  const VariationalInequality above = assemble(scene, conforming), below = assemble(scene, nonconforming);
  EnergyBracket bracket;
  bracket.upper = energy(above, active_set(above));
  bracket.lower = energy_lower_bound(nonconforming, below, active_set(below), scene.body().load);
  return bracket;
}

AccurateEnough accurate_enough(const EnergyBracket& bracket, double coarser, double share) {
  const double scale = std::max(std::abs(bracket.upper), std::abs(bracket.lower));
  if (!(bracket.width() > 0)) return {};
  const double relative = share * bracket.width() / (coarser * coarser) / scale;
  return {relative * relative * scale, relative};
}

CorrectionOptions corrections_until(const AccurateEnough& enough) {
  return corrections_to(std::max(CorrectionOptions{}.tolerance, enough.relative));
}

}  // namespace antilock
