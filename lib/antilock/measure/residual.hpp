#pragma once
#include <Eigen/Core>
#include <vector>

#include "antilock/measure/errors.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Returns the N values a(u, phi_i) - L(phi_i), the residual of the exact solution u in (13) of
/// [SR04] (cited in problem/variational_inequality.hpp). For v in V the residual is the work
/// int_Gamma_C lambda v of the contact pressure lambda on the contact boundary Gamma_C; for
/// Crouzeix-Raviart it also contains the fluxes of u through the jumps of v (the consistency
/// error). `load` is L(phi_i). The stiff part is computed from the layer stress, which is finite at
/// epsilon = 0. `breaks` lists the x where that stress jumps, the ends of contact. A layer triangle
/// that contains such an x is integrated by 1792 points, the others by load_rule.
Eigen::VectorXd consistency_residual(const Space& space, const Eigen::VectorXd& load,
                                     const Reference& exact, const std::vector<double>& breaks);

/// Returns the N values (u, phi_i)_h of the broken H1 inner product, by the rule of measure_errors,
/// for projections of u.
Eigen::VectorXd h1_products(const Space& space, const Reference& exact);

/// Returns the N values int_Gamma_C g phi_i for a density g on the contact boundary Gamma_C. The
/// rule has 32 midpoints per edge, because g may jump.
Eigen::VectorXd contact_work(const Space& space, const Profile& g);

/// Returns the N values of the interpolant of u as in [SR04]: values at the support points for
/// conforming elements (Theorem 5), and means over edges for Crouzeix-Raviart (Section 4.2), by
/// Gauss's rule of 3 points.
Eigen::VectorXd interpolant(const Space& space, const Field& u);

}  // namespace antilock
