#pragma once
#include "antilock/analysis/locking.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// The energy that a discrete solution u_h of (23) or (22) of [SR04] (cited in
/// problem/variational_inequality.hpp) has lost by locking,
///
///     J(u_h) - J(v),   J(v) = a(v, v) / 2 - L(v).
///
/// It compares u_h with functions whose layer can move (locking_loss.cpp constructs them):
/// - v minimises J over a small space. In the body v = u_h + w, w in a space of hats around Sigma,
///   the interface of body and layer. In the layer v has columns of its own, one under each edge of
///   Sigma, so that d_y v = 0 is possible for any trace. v is above the obstacle at the points on
///   Sigma, as u_h is at its points on Gamma_C, the contact boundary.
/// - v' is v plus a function that is affine on each edge of Sigma and constant in y, so that v' is
///   in K: above the obstacle at 33 points per edge.
/// - v_0 is u_h + w in the body as well, and in the layer it is straight: d_y v_0 = 0 and v_0 is
///   affine in x, equal to the prescribed values at the ends of Sigma. Where one end is free, it is
///   constant and has the value of the other end. Where both are free, it is the mean of u_h on
///   Sigma.
///
/// Load and stiffness of J are evaluated at the points where u_h has them, so that quadrature
/// errors cancel in the difference. The loss is not the gain of a finer mesh. A layer of few rows
/// is coarse, which is not locking (measured: rows half as high are worth 18 to 30 % under the feet
/// of a bridge at epsilon = 1, and no loss is reported). Where the waves of a gap are few edges
/// long, u_h meets it at other points than another mesh would (measured, 4.6 edges per wave: 9 %
/// reported, where P1 in columns with points of its own is 3 % better).
struct LockingLoss {
  double estimate = 0;  ///< J(u_h) - J(v), negative where v is the worse of the two
  /// J(u_h) - J(v'), a lower bound of J(u_h) - J(u) up to round-off, u the exact solution.
  /// -infinity where there is no v'.
  double lower_bound = 0;
  /// The energy that the motion of the layer releases: the larger of J(v_0) - J(v) and |v -
  /// v_0|_a^2 / 2, in the energy norm. 0 where that is no more than round-off.
  double reference = 0;

  /// Returns energy / reference, clamped to [0, 1]; 0 where the reference is 0.
  double share(double energy) const;
};

/// Computes the loss for a conforming element of any degree on a mesh with a layer, for a small
/// part of the cost of the solve. The derivation is in locking_loss.cpp. Throws Error for another
/// element, for a mesh without a layer, for a layer along the normals of a curve, and for one with
/// a traction, a spring or prescribed values on its sides that differ from those at the ends of
/// Sigma. Throws as active_set does.
LockingLoss locking_loss(const Scene& scene, const Result& result);

}  // namespace antilock
