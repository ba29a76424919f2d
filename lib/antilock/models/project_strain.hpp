#pragma once
#include "antilock/form/strain_projection.hpp"
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// The problem with the form of an averaged strain, a0_h of `project_strain`, in place of a0. The part
/// `exact_fraction` of a0, 0 or more and less than 1, stays as it is, and moves to a1:
///     a1' = a1 + kept a0,   a0' = (1 - kept) a0_h,   compliance' = projected_class_parameter(compliance, kept)
/// so that a1' + a0'/compliance' = a1 + kept a0 + (1/compliance - kept) a0_h. With the identity as shares it is the
/// same problem; with kept > 0 a1' is as coercive as a1 + kept a0, whatever the shares (Arnold and Brezzi 1993, for
/// plates). Throws Error as `project_strain` and `projected_class_parameter` do.
VariationalInequality project_strain(VariationalInequality problem, const StrainProjection& projection,
                                     double exact_fraction = 0);

/// (1 - kept) c / (1 - kept c): what stands for the class parameter c, from 0 to 1 as c does. For a Sweep of a
/// projected problem. Throws Error unless 0 <= kept < 1 and 0 <= c with kept c < 1.
double projected_class_parameter(double compliance, double exact_fraction);

}  // namespace antilock
