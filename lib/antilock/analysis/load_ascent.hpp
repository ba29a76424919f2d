#pragma once
#include <functional>
#include <vector>

#include "antilock/exact/sine_load.hpp"

namespace antilock {

/// Returns the load sum_k c_k 2 sin(k pi x) cos(pi y / 2), a combination of the modes m = 1 of
/// LoadModes. Its L2 norm is |c|. In the SineLoad the cosine is replaced by its Taylor polynomial
/// of degree 12 (error 1e-8).
SineLoad load_of_modes(const Eigen::VectorXd& c);

/// Returns the largest value of `error` on the unit sphere that projected gradient ascent finds
/// from the starts. It is only a lower bound of the supremum. The gradient is computed by
/// differences, and the step is doubled after a success and halved after a failure.
double ascend(const std::function<double(const Eigen::VectorXd&)>& error,
              const std::vector<Eigen::VectorXd>& starts, int steps = 6);

}  // namespace antilock
