#pragma once
#include <Eigen/Core>
#include <optional>

#include "antilock/measure/result.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

struct ContactZone {
  int points = 0;                  ///< contact unknowns
  int active = 0;                  ///< of these in contact
  std::optional<double> from, to;  ///< x-range of the active ones; empty where none
};
/// The space of the result is that of the component with bounds, one per unknown on Gamma_C. Throws Error for another, for
/// bounds on constraints (they have no point) and for friction.
ContactZone contact_zone(const Result& result);

/// Length of Gamma_C that each contact unknown stands for: its edge (CR), half its two edges (P1). lambda divided by it
/// is the contact pressure as a density (force a unit length).
Eigen::VectorXd contact_lengths(const Space& space);

/// One row per contact unknown: x, gap >= 0 (to the nearer bound), pressure (density) >= 0, <= 0 at an upper bound.
/// C x 3. Throws Error as contact_zone does.
Eigen::MatrixX3d contact_table(const Result& result);

}  // namespace antilock
