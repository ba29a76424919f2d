#pragma once
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/uzawa.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Two numbers with the energy J(u) of the exact solution between them, computed without knowing it.
struct EnergyBounds {
  double lower = 0;  ///< by duality, from a Crouzeix-Raviart solution
  double upper = 0;  ///< J of a function of K, the P1 solution, with what the quadrature leaves of the load

  double width() const { return upper - lower; }
};

/// The bracket of a scene on a mesh, from its certificate: P1 above, a bound from Crouzeix-Raviart below, both by active
/// set. Throws as certify and active_set do.
EnergyBounds energy_bounds(const Scene& scene, const TriangleMesh& mesh);

/// When an iteration for u_h may stop: at `share` of the relative width b = width / |J|, in the energy norm. Why b:
/// errors in the energy norm are of order sqrt(b), those in the maximum norm of order b where u is smooth: less. Since
/// the energy is a square and |u_h|_a^2 = 2 |J| on a cone K,
///     J(v) - J(u_h) <= (share b)^2 |J|   means   |v - u_h|_a <= share b |u_h|_a.
/// This share left every error within 1 % (observed, chapter 21). The bracket may come from a mesh `coarser` times as
/// coarse, where it costs little, and is divided by coarser^2 then (order h^2): cautious where P1 locks. A width that is
/// not positive says nothing, and nothing is enough: both numbers are 0.
AlgebraicTolerance balanced_tolerance(const EnergyBounds& bracket, double coarser = 1, double share = 0.05);

}  // namespace antilock
