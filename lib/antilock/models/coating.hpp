#pragma once
#include <optional>

#include "antilock/models/plane_strain.hpp"

namespace antilock {

/// A block with a stiff coating under it in plane strain: a real part of the kind that the paper's introduction names. The
/// coating has the thickness t and the material `layer` with both moduli divided by t (all lengths relative to the block,
/// all moduli to one scale). Its mesh is stretched to depth 1, Y = y / t. With (u, v) the displacement and nu =
/// lambda / (lambda + 2 mu) of the layer, its energy is half the square of the form
///
///     int membrane u_x^2 + (lambda + 2 mu) (v_Y / t + nu u_x)^2 + mu (u_Y / t + v_x)^2
///
/// (the square in v_Y is completed). So a1 gains membrane u_x^2, membrane = 4 mu (lambda + mu) / (lambda + 2 mu); rows of B
/// per point: v_Y + nu t u_x, of weight lambda + 2 mu, and u_Y + t v_x, of weight mu; and the class parameter is t^2. At t =
/// 0 both rows lose their second term, and what is left of the coating is a membrane of the right modulus. Without the
/// completed square it would be 2 mu at t = 0.
struct Coating : BlockLoading {
  double thickness = 1e-2;             ///< t, in [0, 1]; 0: the limit
  Lame body = {0.3 / 0.52, 1 / 2.6};   ///< of Young's modulus 1 and Poisson's ratio 0.3
  Lame layer = {0.3 / 0.52, 1 / 2.6};  ///< times 1 / t
};

/// The problem (6) of the coating on a mesh with a stretched layer. Throws Error for values out of range and for a mesh
/// without a layer.
VariationalInequality assemble(const Coating& coating, const VectorSpace& space);

/// T values: minus the stress in y, in the body that of the mean strain of a triangle, in the coating the mean of what is
/// found there.
Eigen::VectorXd pressure(const Coating& coating, const VectorSpace& space, const Eigen::VectorXd& u,
                         const Eigen::VectorXd& p);

/// The penalty to solve it with (ActiveSetOptions). B = B_0 + t B_1 depends on t. Where d/dy does not map onto the rows,
/// there are motions of B_0 u = 0 whose B_1 u no small motion can cancel: for them a0 = c t^2 a1, which is neither stiff
/// nor 0, and a penalty far above t^2 brings them in with t^2 / delta per correction. The cure is delta = t^2, as long as
/// the factor keeps digits of A1 beside t^-2 (t >= 1e-6). Of Crouzeix-Raviart's both components d/dy maps onto the rows, and
/// the usual penalty serves: empty.
std::optional<double> penalty(const Coating& coating, const VectorSpace& space);

}  // namespace antilock
