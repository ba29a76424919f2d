#pragma once
#include <optional>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// How far the nearest rows of B are from being dependent, where that decides the answer and cannot be decided: each row
/// in its own unit, each unknown in that of its stiffness, a pivot of the rank-revealing QR between tuned::equal and
/// tuned::apart. Empty: there is none.
///
/// At compliance = 0 a row counts as dependent on the others or it does not, and the answer jumps. Looked for where B has
/// at most tuned::few_rows rows or unknowns: beyond, `kernel_dimension` (analysis/) tells.
std::optional<double> nearly_dependent_rows(const VariationalInequality& problem);

}  // namespace antilock
