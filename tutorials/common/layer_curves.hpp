#pragma once
#include <vector>

#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// u and the contact pressure on Gamma_C, one row per contact unknown: x, u0, u1, ..., pressure0, pressure1, ... in the
/// order of the epsilons.
Table on_contact(const std::vector<double>& epsilons, const Space& space);

/// The layer stress of P1 on a structured mesh (Figure 3) in the top, the middle and the bottom row of cells, one row per
/// inner vertical line: x, top, middle, bottom.
Table stress_by_depth(const Space& space, const Solution& solution);

}  // namespace antilock::tutorial
