#pragma once
#include <Eigen/Core>
#include <utility>

#include "antilock/core/eigen_memory.hpp"
#include "antilock/space/element.hpp"

namespace antilock {

/// A quadrature rule on a triangle: weights sum to 1, to be multiplied by the area.
struct Quadrature {
  Eigen::MatrixX3d points;  ///< q x 3, barycentric
  Eigen::VectorXd weights;  ///< q
};

/// Radon's 7-point rule, exact for polynomials of degree 5 (FreeFEM's qf5pT: loads agree to round-off).
const Quadrature& radon_rule();
/// Strang and Fix's 3-point rule (edge midpoints), exact for degree 2.
const Quadrature& midpoint_rule();
/// A rule exact for the given degree, 0 to 12 (else Error): the centroid, midpoint_rule, radon_rule, and from degree 6
/// on Gauss points in both directions of a square folded to the triangle (Stroud's conical product).
const Quadrature& triangle_rule(int degree);

/// Points (n) and weights (n) of Gauss on (0, 1), exact for degree 2n - 1.
std::pair<Eigen::VectorXd, Eigen::VectorXd> gauss_rule(int n);

/// Barycentric coordinates of the place s on the edge opposite local vertex i: s = 0 at vertex i + 1, 1 at i + 2.
Eigen::Vector3d on_edge(int i, double s);

/// The mean of every basis function of the element on the edge opposite local vertex i, exact.
Eigen::VectorXd means_on_edge(const Element& element, int i);

}  // namespace antilock
