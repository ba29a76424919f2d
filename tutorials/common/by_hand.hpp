#pragma once
#include <Eigen/Core>

namespace antilock::tutorial {

/// One row per corner of a triangle: x and y.
using Corners = Eigen::Matrix<double, 3, 2>;

/// Adds int f phi_i over a triangle of this area to the entries of its three vertices: Radon's rule of seven points
/// lambda, where phi_i(lambda) = lambda_i; f = 10 sin(2 pi x).
void add_loads(Eigen::VectorXd& load, const Eigen::RowVector3i& vertices, const Corners& corners, double area);

}  // namespace antilock::tutorial
