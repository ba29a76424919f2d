#pragma once
#include <optional>
#include <string>

#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// The report on the locking of a solved scene with a layer.
struct LockingReport {
  std::string diagnosis;  ///< one line: whether the method follows the layer as epsilon -> 0, and why
  /// The share of LockingLoss::lower_bound, where the method can lock; empty where it locks and that is not proved.
  std::optional<double> lost = {};
  /// Empty, or one sentence with the word "locks", the share, how it is known (proved, or by a second solve with
  /// columns where `lost` is empty) and the remedies.
  std::string warning = {};
  double estimate = 0;   ///< the share of LockingLoss::estimate
  double reference = 0;  ///< LockingLoss::reference, of which both are shares

  /// One line for a program to print: the warning, or the diagnosis where there is none.
  const std::string& text() const { return warning.empty() ? diagnosis : warning; }
};
/// Empty for a scene without a layer. On aligned layers (in columns) and for elements that do not conform no number is
/// made: what can be told from the mesh costs nothing.
std::optional<LockingReport> report_locking(const Scene& scene, const Space& space,
                                            const VariationalInequality& problem, const Solution& solution);

}  // namespace antilock
