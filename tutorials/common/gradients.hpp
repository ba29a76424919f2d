#pragma once
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// The errors of the gradient of two methods in the seminorm |grad u| of H1, found from the columns h1 and l2, at each
/// number of cells and each epsilon: cells, epsilon, ratio = other / one.
Table gradient_ratios(const Table& one, const Table& other);

}  // namespace antilock::tutorial
