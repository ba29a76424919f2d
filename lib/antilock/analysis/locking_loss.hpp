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
/// lower bound of the energy error J(u_h) - J(u). It is computed without u. The comparison needs
/// three functions (locking_loss.cpp constructs them). Sigma is the interface of body and layer,
/// and Gamma_C the contact boundary, the bottom of the layer.
/// - v minimises J over a small space. In the body v = u_h + w, where w is a combination of hat
///   functions. There is one hat function per unknown on Sigma. Above Sigma there are further rows
///   of hat functions, which are wider the farther they are from Sigma. In the layer v does not use
///   the triangles of the mesh, but columns, one below each edge of Sigma. There d_y v = 0 is
///   possible for any trace of v on Sigma, so v does not lock. v satisfies the bounds at the points
///   of Gamma_C below the unknowns on Sigma. These bounds are interpolated from those of u_h, so
///   that v and u_h see the same obstacle.
/// - v' is in K, and gives the lower bound. v may be below the obstacle between those points, so
///   J(u_h) - J(v) is only an estimate. v' is v plus a function that is affine on each edge of
///   Sigma and constant in y. It lifts v above the obstacle, as far as 33 points per edge show.
/// - v_0 is the reference without a motion of the layer. In the layer d_y v_0 = 0, and v_0 is
///   affine in x with the prescribed values at the ends of Sigma. If one end is free, v_0 is
///   constant and has the value of the other end. If both are free, it is the mean of u_h on Sigma.
///   In the body v_0 = u_h + w, with the w that minimises J for these values on Sigma.
///
/// Load and stiffness are evaluated at the quadrature points of u_h, so that quadrature errors
/// cancel in the difference. The loss does not contain what a finer mesh would gain. A layer with
/// few rows is coarse, but it does not lock because of this. Therefore v has at most as many rows
/// in the layer as the mesh. (Measured at epsilon = 1 in the layer below a bridge, a body on two
/// feet: halving the height of the rows gains 18 to 30 %, and no loss is reported.) Where a gap
/// oscillates over a few edges, the loss depends on the points at which u_h meets the gap.
/// (Example, measured: for a gap with 4.6 edges per wave a loss of 9 % is reported. But P1 on a
/// mesh of columns, which has other contact points, gains only 3 %.)
struct LockingLoss {
  double estimate = 0;  ///< J(u_h) - J(v), negative where v is the worse of the two
  /// J(u_h) - J(v'), a lower bound of J(u_h) - J(u) up to round-off. It is -infinity if there is no
  /// v'.
  double lower_bound = 0;
  /// The energy that the motion of the layer releases: the larger one of J(v_0) - J(v) and |v -
  /// v_0|_a^2 / 2 (energy norm). If v_0 satisfies the bounds of v, the first is at least the
  /// second, because v minimises J. If v_0 violates them, J(v_0) may be lower than J(v), and the
  /// second is a positive measure of the motion. It is set to 0 if it is below its round-off
  /// divided by `significance` (locking.hpp), because a share of `significance` could then consist
  /// of round-off alone.
  double reference = 0;

  /// Returns energy / reference, clamped to [0, 1]; 0 where the reference is 0.
  double share(double energy) const;
};

/// Computes the loss for a conforming element of any degree on a mesh with a layer, for a small
/// part of the cost of the solve. The derivation is in locking_loss.cpp. Throws Error for another
/// element, for a mesh without a layer, for a layer along the normals of a curve, and for a layer
/// whose sides have a traction, a spring, or prescribed values other than those at the ends of
/// Sigma. Throws as active_set does.
LockingLoss locking_loss(const Scene& scene, const Result& result);

}  // namespace antilock
