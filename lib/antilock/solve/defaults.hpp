#pragma once
#include <limits>

/// The constants of solve/ and their reasons. Tolerances that a user can rely on stand in
/// KktTolerances and CorrectionOptions, the constants of the penalty in problem/choose_penalty.hpp,
/// and that of the contact reduction in penalised_cholesky.hpp. All are dimensionless.
namespace antilock::defaults {

/// The distance from 1 to the next double, 2.2e-16.
constexpr double eps = std::numeric_limits<double>::epsilon();

/// The relative round-off of a sum: the rounding of n terms changes their sum by about sqrt(n) eps
/// times their size, so 64 eps is enough for rows of 4096 entries. It is used three times. First, a
/// force is known up to round_off times the sum of the absolute values of its terms. Second, a
/// pivot below round_off times its diagonal entry is round-off (sound problems stay above 1e-12, on
/// meshes and layers of every kind tried). Third, with a penalty below round_off times the
/// stiffness ratio of B' M B and A1, a factor keeps fewer than two digits of A1.
constexpr double round_off = 64 * eps;

/// The relative difference that rounding leaves between two rows of B that are equal in exact
/// arithmetic. An entry of B is a gradient on a triangle: a difference of coordinates times the
/// reciprocal of an area. The difference, the reciprocal and this product take one rounding each.
/// The area is a difference of two products of differences, which takes four. Together these are 7
/// roundings, each of eps / 2. Two such rows differ by 7 eps, and the rounding of u to doubles
/// makes it 8. A row whose residual is within this tolerance counts as satisfied, and two rows
/// within it count as one. Sums and products with u add nothing, because they are exact
/// (residual.hpp).
constexpr double row_tolerance = 8 * eps;

/// The number of rows of B up to which constraint_defect (forward_error.hpp) looks for nearly
/// dependent ones. It also requires that the problem has at most 10 max_rows_for_qr unknowns. The
/// dense QR of a matrix of 200 x 2,200 (one column per unknown, and one per row for its compliance)
/// takes about 2 200^2 2,200 = 1.8e8 products, which is tens of milliseconds.
constexpr int max_rows_for_qr = 200;

/// The default for the number of all corrections together: 15 with each of four penalties, and the
/// rest with the fifth. The fifth penalty is the smallest one, about round_off, which four
/// divisions by 64 reach from 6e-8 (choose_penalty.hpp).
constexpr int max_corrections = 100;

/// The number of corrections with one penalty. A new factor costs as much as 10 to 20 corrections
/// (measured at 1/h = 128).
constexpr int corrections_per_penalty = 15;

/// The next penalty is the last one divided by this number. If a pivot of K is not positive, the
/// penalty is multiplied by this number. A correction multiplies an error by about delta / (delta +
/// sigma), where sigma is an eigenvalue of a0 relative to a1. If this factor was 0.9, it is 0.12
/// with the next penalty.
constexpr double penalty_reduction = 64;

/// Measured contractions are clamped to [1 - max_contraction, max_contraction]. A slower iteration
/// would not reduce the error of u by a factor e in all corrections together.
constexpr double max_contraction = 1 - 1.0 / max_corrections;

/// The smallest penalty of rows of B with fixed compliances, relative to that of the parametric
/// rows (PenalisedCholesky::penalties). Suppose that three stiffnesses lie far apart, and that two
/// of them are in such rows. Then a correction multiplies the error by about penalty / (penalty +
/// compliance of the softer row). With a smaller penalty more rows have their own compliance as
/// penalty, and these converge at once. 1e-3 of the default 6e-8 leaves the factor five digits of
/// A1.
constexpr double fixed_row_penalty_ratio = 1e-3;

/// The stiffness of the equality row that couples c . u to its slack variable w, relative to that
/// of c . u (slack_form.hpp). A correction leaves about 1/4096 of the difference of c . u and w.
/// The ratio is penalty_reduction squared, as if the penalty of this row had been reduced twice.
constexpr double slack_stiffness_ratio = penalty_reduction * penalty_reduction;

}  // namespace antilock::defaults
