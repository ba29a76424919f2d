#pragma once
#include <Eigen/Core>

#include "antilock/space/space.hpp"

namespace antilock {

/// v_h on Gamma_C between its unknowns, by x: x, v_h, and the length that the sample stands for, at `points` midpoints
/// an edge. A nonconforming v_h has two values at a vertex; neither is sampled.
Eigen::MatrixX3d contact_trace(const Space& space, const Eigen::VectorXd& v, int points = 32);

}  // namespace antilock
