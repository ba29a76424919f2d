#pragma once
// The load of chapter 03, by a rule for triangles.
#include "antilock/form/quadrature.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock::tutorial {

/// One row per corner of a triangle: x and y.
using Corners = Eigen::Matrix<double, 3, 2>;

/// Adds int f phi_i over a triangle of this area to the entries of its three vertices: Radon's rule of seven points
/// lambda, where phi_i(lambda) = lambda_i; f = 10 sin(2 pi x).
inline void add_loads(Eigen::VectorXd& load, const Eigen::RowVector3i& vertices, const Corners& corners, double area) {
  for (Eigen::Index q = 0; q < radon_rule().weights.size(); ++q) {
    const Eigen::Vector3d lambda = radon_rule().points.row(q);
    const double x = corners.col(0).dot(lambda);
    load(vertices) += area * radon_rule().weights(q) * paper_load(x, 0) * lambda;
  }
}

}  // namespace antilock::tutorial
