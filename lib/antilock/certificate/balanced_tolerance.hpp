#pragma once
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/uzawa.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Bounds of the energy J(u) = a(u, u) / 2 - L(u) of the exact solution u, computed without knowing
/// u.
struct EnergyBounds {
  double lower = 0;  ///< by duality, from a Crouzeix-Raviart solution
  double upper = 0;  ///< J of the P1 solution, which is in K (certificate.hpp: energy_upper)

  double width() const { return upper - lower; }
};

/// Computes both bounds of a scene on a mesh from its certificate, with P1 for the upper and
/// Crouzeix-Raviart for the lower one, both solved by active_set. Throws as certify and active_set
/// do.
EnergyBounds energy_bounds(const Scene& scene, const TriangleMesh& mesh);

/// Returns the tolerance at which an iteration for u_h may stop: its relative error in the energy
/// norm is at most share b, where b = width / |J| is the relative width of the bounds. Errors in
/// the energy norm are of the order sqrt(b), those in the maximum norm of the order b where u is
/// smooth. The tolerance uses b, which is smaller than sqrt(b) where b < 1. The energy is
/// quadratic, and |u_h|_a^2 = 2 |J| if the admissible set K is a cone. Therefore
///
///     J(v) - J(u_h) <= (share b)^2 |J|   implies   |v - u_h|_a <= share b |u_h|_a.
///
/// With the default share the errors were within 1 % of those after convergence (observed, chapter
/// 21). The bounds may come from a mesh that is coarser by the factor `coarser`, where they cost
/// little. Their width is then divided by coarser^2, because it has order h^2. Where P1 locks, the
/// width falls more slowly. The tolerance is then stricter than necessary, which is safe. Where the
/// width is not positive, both tolerances are 0. Throws Error unless coarser >= 1 and 0 < share <=
/// 1.
AlgebraicTolerance balanced_tolerance(const EnergyBounds& bracket, double coarser = 1,
                                      double share = 0.05);

}  // namespace antilock
