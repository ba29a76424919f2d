#pragma once
#include <optional>

#include "antilock/measure/result.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// Returns the report on the locking of a solved scene, and nothing for a scene without a layer. For
/// layers whose mesh is aligned and for nonconforming elements the mesh decides alone, and no number
/// is computed. Does not throw where locking_loss does: the diagnosis says why there is no number.
std::optional<LockingReport> report_locking(const Scene& scene, const Result& result);

}  // namespace antilock
