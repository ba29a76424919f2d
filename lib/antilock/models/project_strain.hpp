#pragma once
#include "antilock/form/strain_projection.hpp"
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// Returns the problem with the form a0_h of a projected strain, project_strain(form), in place of
/// a0. The part `exact_fraction` of a0, 0 or more and less than 1, is not projected, and moves to
/// a1. With s = exact_fraction:
///
///     a1' = a1 + s a0,   a0' = (1 - s) a0_h
///     compliance' = projected_class_parameter(compliance, s)
///     a1' + a0' / compliance' = a1 + s a0 + (1 / compliance - s) a0_h
///
/// If the projection is the identity, the problem does not change. With s > 0 the coercivity of a1'
/// does not depend on the projection (D. N. Arnold and F. Brezzi 1993, for plates). Throws Error as
/// `project_strain` and `projected_class_parameter` do.
VariationalInequality project_strain(VariationalInequality problem,
                                     const StrainProjection& projection, double exact_fraction = 0);

/// Returns (1 - s) c / (1 - s c), s = exact_fraction, the class parameter of the projected problem
/// for the compliance c. It increases with c, from 0 at c = 0 to 1 at c = 1. Throws Error unless 0
/// <= s < 1 and 0 <= c with s c < 1.
double projected_class_parameter(double compliance, double exact_fraction);

}  // namespace antilock
