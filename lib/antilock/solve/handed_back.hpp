#pragma once
#include "antilock/problem/bounded_unknowns.hpp"
#include "antilock/solve/kkt.hpp"

namespace antilock {

/// The answer of `problem` from that of basis.problem: u = T w, lambda in the units of the problem's own rows, and the
/// report of the conditions in u. Throws NotConverged where that report is above levels.refused.
///
/// active_set(problem) and uzawa(problem) do this themselves. With a factor made before:
///
///     const BoundedUnknowns basis(problem);
///     PenaltyFactor factor(basis.problem);
///     const Solution s = handed_back(problem, basis, active_set(basis.problem, factor));
Solution handed_back(const VariationalInequality& problem, const BoundedUnknowns& basis, Solution of_w,
                     const TrustLevels& levels = {});

}  // namespace antilock
