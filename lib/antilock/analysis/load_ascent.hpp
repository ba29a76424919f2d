#pragma once
#include <functional>
#include <vector>

#include "antilock/exact/sine_load.hpp"

namespace antilock {

/// The load sum_k c_k 2 sin(k pi x) cos(pi y / 2), of L2 norm |c|: the modes m = 1 of LoadModes, as a SineLoad (the
/// cosine by its Taylor polynomial of degree 12, to 1e-8).
SineLoad load_of_modes(const Eigen::VectorXd& c);

/// A maximum of `error` on the unit sphere by ascent: gradient by differences, the step doubled after a success and
/// halved after a failure, from each start. The largest found: a lower bound of the supremum, no more.
double ascend(const std::function<double(const Eigen::VectorXd&)>& error, const std::vector<Eigen::VectorXd>& starts,
              int steps = 6);

}  // namespace antilock
