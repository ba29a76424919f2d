#pragma once
#include "antilock/measure/result.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// The energy that a conforming element loses on tetrahedra, by its own solutions on another mesh:
/// the same body, and below each face of Sigma, the interface of body and layer, a column. With J
/// as in LockingLoss, u_c the solution on columns, and v_0 the function of least energy whose layer
/// is at rest: u = 0 in a layer with clamped sides, otherwise 0 or the mean of u_h in the layer,
/// moved into the bounds, whichever has less energy,
///
///     estimate = J(u_h) - J(u_c),   reference = J(v_0) - J(u_c).
///
/// u_c satisfies the bounds at vertices. For `lower_bound` they are raised until u_c is above the
/// obstacle at 45 points of each face of Gamma_C, so that u_c is in K as far as these points show.
/// Then the share of the lower bound is at most (J(u_h) - J(u)) / (J(v_0) - J(u)), u the exact
/// solution (section 11 of tutorials/guides/locking_loss.md). It holds at every epsilon and on any
/// mesh, up to the quadrature error of the loads.
struct LossBesideColumns {
  double estimate = 0;
  double lower_bound = 0;
  double reference = 0;        ///< of `estimate`
  double bound_reference = 0;  ///< of `lower_bound`

  double estimated_share() const;  ///< estimate / reference, from 0 to 1
  double proved_share() const;     ///< lower_bound / bound_reference, from 0 to 1
};

/// Computes the loss by two solves, by one more where the obstacle between vertices is above the
/// affine function through them, and by one more where the sides of the layer are free. Throws
/// Error for another element or mesh, for a layer whose sides are not all clamped or all free,
/// where the layer at rest is beyond an obstacle, and where no function on columns is above it.
/// Throws as active_set does.
LossBesideColumns loss_beside_columns(const Scene& scene, const Result& result);

}  // namespace antilock
