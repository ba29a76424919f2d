#pragma once
#include <vector>

#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

// What chapter 12 leaves out of its page.

/// epsilon from 1 to 1e-10 by half decades, and 0.
std::vector<double> half_decades();

/// The hypothesis of Theorem 4: h and the distance from u^0 to K_0h, on three meshes down to 1/finest.
Table distances_to_limit(const Method& method, int finest);

/// Theorem 5 or 7, Remark 4 and the locking ratio of a method that does not lock: `worst` has the columns h, h1,
/// energy, ratio.
void judge_uniform(const Method& method, const Table& worst, Report& report);

}  // namespace antilock::tutorial
