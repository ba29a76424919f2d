#pragma once
#include "antilock/analysis/locking.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// The energy that a discrete solution u_h of (23) or (22) of [SR04] (cited in
/// problem/variational_inequality.hpp) has lost by locking,
///
///     J(u_h) - J(v),   J(v) = a(v, v) / 2 - L(v),
///
/// where a is the left side of the problem: a1 + epsilon^-2 a0 for (23). Every v in K, the set of
/// admissible functions, has J(v) >= J(u), u the exact solution. So J(u_h) - J(v) for a v in K is a
/// lower bound of the energy error J(u_h) - J(u). It is computed without u.
/// tutorials/guides/locking_loss.md constructs three functions, proves the bound, and works through
/// an example by hand:
/// - v minimises J over a small space: u_h and hat functions in the body, columns in the layer. It
///   satisfies the bounds of u_h, interpolated to the unknowns on Sigma, the interface of body and
///   layer.
/// - v' in K is v and a lift above the obstacle, as far as 33 points per edge show. It is affine on
///   each edge of Sigma.
/// - v_0 is the reference without a motion of the layer: d_y v_0 = 0, and affine in x.
///
/// The loss does not contain what a finer mesh would gain, because v has at most as many rows in
/// the layer as the mesh. Where a gap oscillates over a few edges, the loss depends on the points
/// at which u_h meets the gap. (Measured: for a gap with 4.6 edges per wave a loss of 9 % is
/// reported, but P1 on a mesh of columns, which has other contact points, gains only 3 %.)
struct LockingLoss {
  double estimate = 0;  ///< J(u_h) - J(v), negative where v is the worse of the two
  /// J(u_h) - J(v'), a lower bound of J(u_h) - J(u) up to round-off and to the quadrature error of
  /// L(u_h - v'). It is -infinity if there is no v'.
  double lower_bound = 0;
  /// The energy that the motion of the layer releases: the larger one of J(v_0) - J(v) and |v -
  /// v_0|_a^2 / 2 (energy norm). The second one is for a v_0 that violates the bounds. It is set to
  /// 0 if it is below its round-off divided by `significance` (locking.hpp), because the round-off
  /// alone would then be a share that is reported.
  double reference = 0;

  /// Returns energy / reference, clamped to [0, 1]; 0 where the reference is 0. share(lower_bound)
  /// is at most (J(u_h) - J(u)) / (J(v_0) - J(u)) where v_0 satisfies the bounds of u_h and of v
  /// and there is no upper obstacle (section 7 of the guide).
  double share(double energy) const;
};

/// Computes the loss for a conforming element of any degree on a mesh with a layer, for a small
/// part of the cost of the solve. Throws Error for another element, for a mesh without a layer, for
/// a layer along the normals of a curve, and for a layer whose edges have a traction, a spring, or
/// prescribed values other than those that are prescribed on Sigma above them. Throws as active_set
/// does.
LockingLoss locking_loss(const Scene& scene, const Result& result);

}  // namespace antilock
