#pragma once
#include <optional>

#include "antilock/measure/result.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Reports the locking of a solved scene with a layer. Empty for a scene without a layer. On aligned layers (in columns) and for elements that do not conform no number is
/// made: what can be told from the mesh costs nothing.
std::optional<LockingReport> report_locking(const Scene& scene, const Space& space,
                                            const VariationalInequality& problem, const Solution& solution);

}  // namespace antilock
