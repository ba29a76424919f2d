#pragma once
#include <optional>

#include "antilock/measure/result.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// Reports the locking of a solved scene with a layer. Empty for a scene without a layer. On aligned layers (in columns) and for elements that do not conform no number is
/// made: what can be told from the mesh costs nothing.
std::optional<LockingReport> report_locking(const Scene& scene, const Result& result);

}  // namespace antilock
