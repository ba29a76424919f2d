#pragma once
#include <optional>

#include "antilock/measure/result.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// Returns the report on the locking of a solved scene (LockingReport, measure/result.hpp), and
/// nothing for a scene without a layer. Nothing can lock in a Ventcel layer, which has no mesh,
/// with a nonconforming element, or on an aligned mesh (layer_components.hpp). Then the diagnosis
/// says so, and locking_loss is not called. Otherwise locking_loss measures the energy that is
/// lost, as a share of the energy that the motion of the layer releases:
/// - It warns if the share of the estimate is at least `significance` (locking.hpp), 5 %.
/// - The warning says "proved" and gives the share of the lower bound if this share, too, is at
///   least `significance`. Otherwise it gives the estimate, and `lost` is empty.
///
/// On tetrahedra loss_beside_columns measures the same, with comparison_significance, 25 %, in place of 5 %.
/// Where it throws locking_beside_cr makes an estimate. On more than a million faces nothing is
/// measured, and the report warns of each mesh that is not aligned. On quadrilaterals nothing is
/// known.
///
/// It does not throw Error where locking_loss does. The diagnosis then says why there is no number.
/// Section 10 of tutorials/guides/locking_loss.md lists all cases.
std::optional<LockingReport> report_locking(const Scene& scene, const Result& result);

}  // namespace antilock
