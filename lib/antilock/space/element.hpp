#pragma once
#include <Eigen/Core>
#include <string>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

/// An element: the support points of its unknowns and its basis, in barycentric coordinates lambda.
/// Local order of the unknowns: vertices 0 1 2, then edges 0 1 2 (edge i opposite vertex i), then the interior.
class Element {
 public:
  virtual ~Element() = default;
  virtual std::string name() const = 0;
  virtual int degree() const = 0;  ///< of the polynomials of the basis: what a quadrature must be exact for
  virtual bool conforming() const { return true; }  ///< V_h is part of V: no jumps
  virtual int dofs_per_vertex() const = 0;          ///< unknowns at a vertex
  virtual int dofs_per_edge() const = 0;  ///< unknowns on an edge, ordered from its vertex i+1 to its vertex i+2
  virtual int dofs_per_cell() const = 0;  ///< unknowns inside a triangle
  /// m x 3: barycentric coordinates of the m unknowns; basis function i is 1 at row i and 0 at the others.
  virtual Eigen::MatrixX3d support_points() const = 0;
  /// m values of the basis at lambda.
  virtual Eigen::VectorXd basis(const Eigen::Vector3d& lambda) const = 0;
  /// m x 3 derivatives d phi_i / d lambda_j; the gradient is this times grad lambda (3 x 2).
  virtual Eigen::MatrixX3d derivative(const Eigen::Vector3d& lambda) const = 0;

  int dofs() const { return 3 * dofs_per_vertex() + 3 * dofs_per_edge() + dofs_per_cell(); }
};

/// The elements, one instance each, alive as long as the program: P1, P2, P3 and P4 (conforming; beyond P1 contact is
/// asked at the unknowns on Gamma_C alone, so that K_h is not part of K), CR (Crouzeix-Raviart, P1 nonconforming of
/// Section 4.2: edge midpoints) and P1 with a bubble per triangle, which is P1 on every edge.
const Element& p1();
const Element& p2();
const Element& p3();
const Element& p4();
const Element& crouzeix_raviart();
const Element& p1_bubble();
/// P1 to P6 by their degree; throws Error for another.
const Element& lagrange(int degree);
/// By name, "P1" to "P6", "CR" or "P1+bubble"; throws Error for another.
const Element& element(const std::string& name);

}  // namespace antilock
