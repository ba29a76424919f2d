#pragma once
#include <Eigen/Core>
#include <optional>

#include "antilock/measure/result.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

struct ContactZone {
  int points = 0;                  ///< contact unknowns
  int active = 0;                  ///< those in contact
  std::optional<double> from, to;  ///< the range of x of those in contact; empty if there are none
};
/// Returns the contact zone of a solution. The space of `result` must be that of the bounded
/// component, with one bound per unknown on Gamma_C, the contact boundary. Throws Error for another
/// space, for bounds on constraints, which have no point, and for friction.
ContactZone contact_zone(const Result& result);

/// Returns the length of Gamma_C that belongs to each contact unknown: the length of its edge for
/// CR, and half of the lengths of its two edges for P1. lambda divided by it is the contact
/// pressure as a density (force per length).
Eigen::VectorXd contact_lengths(const Space& space);

/// Returns a row per contact unknown (C x 3): x, the distance to the nearer bound, and the contact
/// pressure (a density), >= 0 at a lower bound and <= 0 at an upper one. Throws Error as
/// contact_zone does.
Eigen::MatrixX3d contact_table(const Result& result);

}  // namespace antilock
