#pragma once
#include "antilock/measure/errors.hpp"

namespace antilock {

/// measure_errors, which also says where: by_triangle, T values, is the error of each triangle in the energy norm. The sum
/// of their squares is the square of `energy`.
Errors measure_errors(const Space& space, const Solution& solution, double epsilon, const Reference& reference,
                      Eigen::VectorXd& by_triangle);

}  // namespace antilock
