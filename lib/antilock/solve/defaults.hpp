#pragma once
#include <limits>

/// The constants of solve/ that are neither promises (KktTolerances, CorrectionOptions) nor mathematics, and why they
/// are what they are. Those of the penalty stand in problem/choose_penalty.hpp, that of the
/// contact reduction in penalised_cholesky.hpp.
namespace antilock::defaults {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// A sum of n rounded terms loses about sqrt(n) eps of them: 64 eps serves rows of 4096 entries. A force is known to so
/// much of its terms; a pivot below so much of its diagonal entry is nothing but its round-off (sound problems stay
/// above 1e-12, on meshes and layers of every kind); of a penalty below it, times the stiffness of B' M B beside A1, a
/// factor keeps fewer than two digits of A1.
constexpr double round_off = 64 * eps;

/// What rounding leaves between two rows that are equal. An entry of B, a gradient on a triangle, is a difference of
/// coordinates (1 rounding) times the reciprocal of an area (two products of differences and their difference: 4, and
/// 1): 7 with the last product, each of eps / 2. Two such rows: 7 eps, and the rounding of u to doubles makes it 8. So
/// near a row of B is closed, and two rows are one. Sums and products with u add nothing: they are exact
/// (residual.hpp).
constexpr double row_tolerance = 8 * eps;

/// Rows of B whose distance from dependent is looked at, among ten times as many unknowns at most: a dense QR of 200 x
/// 2,200 (with a spring per row) is some 2 200^2 2,200 products, tens of milliseconds.
constexpr int max_rows_for_qr = 200;

/// Corrections in all, where the caller asks for no other number: 15 with each of four penalties, and the rest with the
/// fifth. That is the smallest one, round_off, which four steps of 64 reach from 6e-8 (choose_penalty.hpp).
constexpr int max_corrections = 100;

/// Corrections with one penalty: a new factor costs as much as 10 to 20 (measured at 1/h = 128).
constexpr int corrections_per_penalty = 15;

/// By which the next penalty is smaller, and larger where K has no positive pivots. A correction contracts like delta /
/// (delta + sigma): 0.9 becomes 0.12.
constexpr double penalty_reduction = 64;

/// A rate of convergence outside 1 - slowest to slowest is not believed: what is slower makes the error of u no smaller
/// by a factor e in all corrections that are made.
constexpr double max_contraction = 1 - 1.0 / max_corrections;

/// The penalty of rows with compliances of their own, at least, beside the one of choose_penalty. Where three stiffnesses
/// lie far apart, two of them in such rows, a correction contracts like penalty / (penalty + the softer one's compliance):
/// the smaller the penalty, the more of them the factor has as they are. 6e-11 leaves the factor five digits of A1.
constexpr double fixed_row_penalty_ratio = 1e-3;

/// The row that ties c . u to its slack variable w is stiffer than c . u by this factor: a correction leaves
/// about 1/4096 of the distance between the two, as if it were made with two penalties less.
constexpr double slack_stiffness_ratio = penalty_reduction * penalty_reduction;

}  // namespace antilock::defaults
