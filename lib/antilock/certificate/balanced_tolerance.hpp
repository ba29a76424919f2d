#pragma once
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/uzawa.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Two numbers with the energy J(u) of the exact solution between them, computed without knowing
/// it.
struct EnergyBounds {
  double lower = 0;  ///< by duality, from a Crouzeix-Raviart solution
  double upper = 0;  ///< J of a function of K, the P1 solution, with what the quadrature leaves of the load

  double width() const { return upper - lower; }
};

/// Computes both bounds of a scene on a mesh from its certificate, with P1 for the upper and
/// Crouzeix-Raviart for the lower one, both solved by active_set. Throws as certify and active_set
/// do.
EnergyBounds energy_bounds(const Scene& scene, const TriangleMesh& mesh);

/// Returns the tolerance at which an iteration for u_h may stop: the fraction `share` of the
/// relative width b = width / |J|, in the energy norm. Because errors in the energy norm are of the
/// order sqrt(b), and those in the maximum norm of the order b where u is smooth, b is the smaller
/// of the two. Since the energy is quadratic and |u_h|_a^2 = 2 |J| on a cone K,
///
///     J(v) - J(u_h) <= (share b)^2 |J|   implies   |v - u_h|_a <= share b |u_h|_a.
///
/// The default share left every error within 1 % (observed, chapter 21). The bounds may come from a
/// mesh that is coarser by the factor `coarser`, where they cost little. Their width is then
/// divided by coarser^2 (order h^2), which is cautious where P1 locks. Where the width is not
/// positive, both tolerances are 0. Throws Error unless coarser >= 1 and 0 < share <= 1.
AlgebraicTolerance balanced_tolerance(const EnergyBounds& bracket, double coarser = 1, double share = 0.05);

}  // namespace antilock
