#pragma once
#include <Eigen/Core>
#include <vector>

#include "antilock/measure/errors.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// N values a(u, phi_i) - L(phi_i), u the exact solution: what the terms of (13) are made of. For v in V it is the work
/// int_Gamma_C lambda v of the contact pressure; for Crouzeix-Raviart the fluxes of u through the jumps of v come on
/// top (consistency). `load`: L(phi_i). The stiff part is taken as the layer stress, so epsilon = 0 is no exception.
/// `breaks`: the x where that stress jumps (the ends of contact); layer triangles across them are integrated by 1792
/// points, the others by load_rule.
Eigen::VectorXd consistency_residual(const Space& space, const Eigen::VectorXd& load, const Reference& exact,
                                     const std::vector<double>& breaks);

/// N values (u, phi_i)_h in the broken H1 product, by the rule that measure_errors uses: for projections of u.
Eigen::VectorXd h1_products(const Space& space, const Reference& exact);

/// N values int_Gamma_C g phi_i, g a density on the line (32 midpoints an edge: g may jump).
Eigen::VectorXd contact_work(const Space& space, const Profile& g);

/// N values that interpolate as the paper does: at the points of the unknowns for conforming elements (Theorem 5),
/// means over edges for Crouzeix-Raviart (Section 4.2, Gauss's rule of 3 points).
Eigen::VectorXd interpolant(const Space& space, const Field& u);

}  // namespace antilock
