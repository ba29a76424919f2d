#pragma once
#include <optional>

#include "antilock/problem/variational_inequality.hpp"

namespace antilock {

/// How far the nearest rows of B are from being dependent, where that decides the answer and cannot be decided: each row
/// in its own unit, each unknown in that of its stiffness, a pivot of the rank-revealing QR between 2e-15 (8 eps) and 3e-9.
/// Empty: there is none.
///
/// At compliance = 0 a row counts as dependent on the others or it does not, and the answer jumps. Rows that differ by
/// 2e-15 or less are equal up to the round-off of assembly and count as dependent; from 3e-9 on the solver holds them
/// apart. (Measured: three springs are right to 1e-12, from 1e-13 on as if equal; rows (1, 1) and (1, 1 + d) under the
/// load (1, 1), for which u = 0, are right to d = 1e-8, pivot 5e-9, and leave u = d / 4 from 1e-9 on.) Looked for where B
/// has at most 200 rows or unknowns: beyond, `kernel_dimension` (analysis/) tells.
std::optional<double> nearly_dependent_rows(const VariationalInequality& problem);

}  // namespace antilock
