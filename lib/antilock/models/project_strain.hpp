#pragma once
#include "antilock/form/strain_projection.hpp"
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// The problem with the form of a projected strain, a0_h of project_strain(form), in place of a0. The part
/// `exact_fraction` of a0, 0 or more and less than 1, stays as it is, and moves to a1:
///     a1' = a1 + s a0,   a0' = (1 - s) a0_h,   compliance' = projected_class_parameter(compliance, s)
/// so that a1' + a0'/compliance' = a1 + s a0 + (1/compliance - s) a0_h, s = exact_fraction. With the identity it is the
/// same problem; with s > 0 a1' is as coercive as a1 + s a0, whatever the projection (Arnold and Brezzi 1993, for
/// plates). Throws Error as `project_strain` and `projected_class_parameter` do.
VariationalInequality project_strain(VariationalInequality problem, const StrainProjection& projection,
                                     double exact_fraction = 0);

/// (1 - s) c / (1 - s c), s = exact_fraction: the class parameter of the projected problem for c, from 0 to 1 as c
/// does. For a Sweep of a projected problem. Throws Error unless 0 <= s < 1 and 0 <= c with s c < 1.
double projected_class_parameter(double compliance, double exact_fraction);

}  // namespace antilock
