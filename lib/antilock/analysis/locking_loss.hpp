#pragma once
#include "antilock/analysis/locking.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// The energy that a discrete solution has lost by locking. J(v) = a(v, v)/2 - L(v); v is a function whose layer is
/// free to move, above the obstacle at the points on Sigma, as u_h is at its own points on Gamma_C. Load and stiffness
/// are those that u_h has at its points: what both miss is in neither.
/// It is not what a finer mesh would gain. A layer of few rows is coarse, which is not locking (measured: rows half as
/// high are worth 18 to 30 % under the feet of a bridge at epsilon = 1, and no loss is reported). And where the waves
/// of a gap are few edges long, u_h meets it at other points than another mesh would (measured, 4.6 edges per wave: 9
/// % reported, where P1 in columns with points of its own is 3 % better).
struct LockingLoss {
  double estimate = 0;  ///< J(u_h) - J(v), negative where v is the worse of the two
  /// J(u_h) - J(v') <= J(u_h) - J(u), up to round-off: v' is v, lifted into K as 33 points per edge show it; -infinity
  /// where it cannot be lifted.
  double lower_bound = 0;
  /// The energy that the motion of the layer releases: the larger of J(v_0) - J(v) and |v - v_0|_a^2 / 2, v_0 the
  /// function whose layer is held straight; 0 where that is no more than round-off.
  double reference = 0;

  /// `energy` over the reference, 0 to 1; 0 where the reference is 0.
  double share(double energy) const;
};

/// For a conforming element of any degree on a mesh with a layer, of (23) or (22); derivation in locking_loss.cpp.
/// Costs a small part of the solve. Throws Error for another element, without a layer's mesh, for a layer along the
/// normals of a curve and for one whose sides are given other values than Sigma's ends, a traction or a spring, and
/// what active_set throws.
LockingLoss locking_loss(const Scene& scene, const Result& result);

}  // namespace antilock
