#pragma once
#include <Eigen/Core>
#include <utility>

#include "antilock/mesh/cell_kind.hpp"

namespace antilock {

/// A quadrature rule on the reference cell of a kind, in its coordinates. The weights sum to 1. On
/// a simplex T int_T f is about |T| sum_q weights_q f(points_q).
struct Quadrature {
  ReferencePoints points;   ///< q x c
  Eigen::VectorXd weights;  ///< q
};

/// Returns Radon's 7-point rule, exact for polynomials of degree 5. It is FreeFEM's qf5pT, so that
/// loads agree with those of FreeFEM to round-off.
const Quadrature& radon_rule();
/// Returns the rule of the 3 edge midpoints, exact for degree 2 (Strang and Fix).
const Quadrature& midpoint_rule();
/// Returns a rule that is exact for the given degree: the centroid, midpoint_rule or radon_rule,
/// and from degree 6 on Stroud's conical product (Gauss points in both directions of a square that
/// is mapped to the triangle). Throws Error for a degree outside 0 to 12.
const Quadrature& triangle_rule(int degree);
/// Returns such a rule on the reference cell of a kind. On a tetrahedron it is the centroid, the
/// four points of Hammer and Stroud for degree 2, and the conical product from degree 3 on. On a
/// quadrilateral it is the product of two Gauss rules, exact for this degree in s and in t.
const Quadrature& cell_rule(CellKind kind, int degree);
/// Returns the rule of this degree on a facet of a kind: points in the barycentric coordinates of
/// the facet (q x d), in the order of its vertices.
Quadrature facet_rule(CellKind kind, int degree);
/// Returns the point of the reference cell with the barycentric coordinates mu (d) on facet i.
ReferencePoint on_facet(CellKind kind, int i, const ReferencePoint& mu);

/// Returns points (n) and weights (n) of Gauss's rule on (0, 1), exact for degree 2n - 1.
std::pair<Eigen::VectorXd, Eigen::VectorXd> gauss_rule(int n);

/// Returns the barycentric coordinates of the point s on the edge opposite local vertex i: s = 0 at
/// vertex i + 1, 1 at i + 2.
Eigen::Vector3d on_edge(int i, double s);

}  // namespace antilock
