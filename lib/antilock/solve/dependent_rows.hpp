#pragma once
#include <optional>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// How far the nearest rows of B are from being dependent, where that decides the answer and cannot be decided: each row
/// in its own unit, each unknown in that of its stiffness, a pivot of the rank-revealing QR between 1e-14 and 1e-10.
/// Empty: there is none.
///
/// At compliance = 0 a row counts as dependent on the others or it does not, and the answer jumps. Rows that differ by
/// 1e-14 or less are equal up to the round-off of assembly and count as dependent; from 1e-10 on the solver holds them
/// apart. (Measured, three springs: right to 1e-12, from 1e-13 on as if equal.) Looked for where B has at most 200 rows
/// or unknowns: beyond, `kernel_dimension` (analysis/) tells.
std::optional<double> nearly_dependent_rows(const VariationalInequality& problem);

}  // namespace antilock
