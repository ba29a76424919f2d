#pragma once
#include <vector>

#include "antilock/exact/beam_truth.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/study/table.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

/// The largest error of the deflection w at a node.
double nodal_error(const Beam& beam, const Solution& solution);

/// The error against epsilon from 1e-2 to 1e-8, by full and reduced integration: integration, cells, epsilon,
/// error. One sweep per mesh and integration.
Table beam_errors(const std::vector<int>& cells);

/// For the picture: deflections and nodal forces, one row per node.
Table draw_beam(const Beam& beam, const Solution& full, const Solution& reduced);

}  // namespace antilock::tutorial
