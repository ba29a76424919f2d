#pragma once
#include "antilock/form/factored_form.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// The part of the jump of u across an edge that the form penalises: all of it, or only its mean
/// over the edge.
enum class PenalisedJump { whole, mean };

/// The parameters of the symmetric interior penalty method (D. N. Arnold, SIAM J. Numer. Anal.
/// 19, 1982; D. N. Arnold, F. Brezzi, B. Cockburn and L. D. Marini, SIAM J. Numer. Anal. 39,
/// 2002). The method that penalises only the mean of the jump is that of P. Hansbo and M. G.
/// Larson, ESAIM: M2AN 37, 2003, without their second penalty.
struct InteriorPenalty {
  /// Dimensionless, above 1. The form is then coercive on every mesh, because the penalty of an
  /// edge contains the sizes of its triangles (K. Shahbazi, J. Comput. Phys. 205, 2005).
  double gamma = 3;
  PenalisedJump penalised = PenalisedJump::whole;
};

/// Returns, in factors, the symmetric interior penalty form of one derivative d = d/dx_axis (axis
/// 0 or 1) on the triangles T of one region:
///
///     sum_T int_T d u d v - sum_E int_E n ({d u} [v] + {d v} [u])
///                         + sum_E eta_E int_E n^2 P[u] P[v]
///
/// n is the component of the normal of the edge E on this axis, [u] the jump, and P[u] the jump
/// or its mean. The sides of an edge have weights w_T:
///
///     1/2 and 1/2   between two triangles of the region
///     1             on a Dirichlet edge, where [u] = u, so that u = 0 is imposed weakly (Nitsche)
///     1 and 0       on Sigma: 1 in the body, 0 in the layer (see below)
///     0             on Gamma_C and free edges
///
///     {d u} = sum of w_T d u over the sides,   eta_E = gamma sum of 3 w_T^2 |E| / |T|
///
/// The weights of a jump of the stiffness k are w_1 = k_2 / (k_1 + k_2) (A. Ern, A. F. Stephansen
/// and P. Zunino, IMA J. Numer. Anal. 29, 2009). On Sigma they are taken in the limit of a rigid
/// layer, so that they do not depend on epsilon. The method is consistent, because the stress n .
/// A grad u is the same on both sides.
///
/// Let m_k be the mean of the jump on edge k of T, D_k the difference of the jump between the two
/// ends of the edge, and c_k = w_T |E_k| n_k, n outward. A triangle has the rows
///
///     d u - (c_1 m_1 + c_2 m_2 + c_3 m_3) / |T|
///     sqrt(3 gamma) (c_k m_k - alpha (c_1 m_1 + c_2 m_2 + c_3 m_3)) / |T|,   k = 1, 2, 3
///     sqrt(gamma / 4) c_k D_k / |T|,   k = 1, 2, 3,   if the whole jump is penalised
///
/// with alpha = (1 - sqrt(1 - 1 / gamma)) / 3, and |T| in M for each. The first row is the
/// derivative of the affine function whose values at the midpoints are weighted means of both
/// sides (at w = 1/2 their average). The rows are ordered by kind: first one row of the first
/// kind per triangle of the region, in the order of the mesh, then the others. Rows that are 0
/// are left out of the second and the third kind.
///
/// The space must be one of discontinuous P1. Throws Error for another element, and NotConverged
/// for gamma <= 1, where the form need not be coercive.
FactoredForm interior_penalty_form(const Space& space, Region region, int axis,
                                   const InteriorPenalty& method);

}  // namespace antilock
