#pragma once
#include <optional>

#include "antilock/models/plane_strain.hpp"

namespace antilock {

/// A block with a stiff coating under it in plane strain, a structure of the kind that the
/// introduction of [SR04] names (cited in problem/variational_inequality.hpp). The coating has the
/// thickness t and the material `layer`, both of whose moduli are divided by t. Lengths are
/// relative to the block, and all moduli are relative to the same modulus. The mesh of the coating
/// is stretched to depth 1, Y = y / t. Let (u, v) be the displacement and r = lambda / (lambda + 2
/// mu) of the layer, which is nu / (1 - nu) for Poisson's ratio nu. The energy of the coating is
/// half of
///
///     int membrane u_x^2 + (lambda + 2 mu) (v_Y / t + r u_x)^2 + mu (u_Y / t + v_x)^2,
///     membrane = 4 mu (lambda + mu) / (lambda + 2 mu),
///
/// where the square in v_Y is completed. The first term belongs to a1. B has two rows per point,
/// v_Y + r t u_x with the weight lambda + 2 mu and u_Y + t v_x with the weight mu, and the class
/// parameter is t^2. At t = 0 both rows lose their second term, and the coating becomes a membrane
/// of the right modulus, `membrane`. Without the completed square its modulus would be 2 mu, which
/// is wrong.
struct Coating : BlockLoading {
  double thickness = 1e-2;             ///< t, in [0, 1]; 0 is the limit
  Lame body = {0.3 / 0.52, 1 / 2.6};   ///< of Young's modulus 1 and Poisson's ratio 0.3
  Lame layer = {0.3 / 0.52, 1 / 2.6};  ///< the material whose moduli are divided by t
};

/// Assembles the problem (6) of the coating on a mesh with a stretched layer. Throws Error for
/// values out of range and for a mesh without a layer.
VariationalInequality assemble(const Coating& coating, const VectorSpace& space);

/// Returns T values of the pressure, which is minus the stress in y. In the body it is computed
/// from the mean strain of each triangle. In the coating it is the mean of the pressure over each
/// triangle. `p` is Solution::p.
Eigen::VectorXd pressure(const Coating& coating, const VectorSpace& space, const Eigen::VectorXd& u,
                         const Eigen::VectorXd& p);

/// Returns the penalty (ActiveSetOptions::penalty) with which the problem of the coating should be
/// solved, or nothing if the default is right. B = B_0 + t B_1 depends on t. If d_y is not
/// surjective onto the rows of B, there are u with B_0 u = 0 for which no small correction v
/// satisfies B_0 v = -t B_1 u. For such u the stiff term t^-2 a0 is only of the order of a1, so it
/// is neither stiff nor 0. With a penalty delta far above t^2 they converge slowly: a correction
/// removes only the fraction t^2 / delta of their error. The remedy is delta = t^2, as long as the
/// factor keeps digits of A1 beside t^-2 (t >= 1e-6; below, delta is 1e-12). With Crouzeix-Raviart
/// for both components d_y is surjective.
std::optional<double> penalty(const Coating& coating, const VectorSpace& space);

}  // namespace antilock
