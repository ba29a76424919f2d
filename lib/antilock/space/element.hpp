#pragma once
#include <Eigen/Core>
#include <string>

#include "antilock/core/eigen_memory.hpp"

namespace antilock {

/// A degree of freedom as a functional of a function v on a triangle, sum_q weights_q v(points_q).
/// It is the value at one point, or a weighted mean by a quadrature rule. The weights sum to 1.
struct DofFunctional {
  Eigen::MatrixX3d points;  ///< q x 3, barycentric
  Eigen::VectorXd weights;  ///< q
};

/// A finite element on a triangle: its m unknowns, their support points and its basis, in
/// barycentric coordinates lambda. The local order of the unknowns is: vertices 0 1 2, edges 0 1 2
/// (edge i is opposite vertex i), the interior.
class Element {
 public:
  virtual ~Element() = default;
  virtual std::string name() const = 0;
  /// Returns k: the derivatives have degree k - 1, and the quadrature of forms and loads follows
  /// from k.
  virtual int degree() const = 0;
  virtual int basis_degree() const { return degree(); }  ///< the polynomial degree of the basis
  virtual bool conforming() const { return true; }       ///< V_h is a subspace of V: no jumps
  virtual int dofs_per_vertex() const = 0;               ///< unknowns at a vertex
  /// Unknowns on an edge, ordered from its vertex i+1 to its vertex i+2.
  virtual int dofs_per_edge() const = 0;
  virtual int dofs_per_cell() const = 0;  ///< unknowns inside a triangle
  /// Returns the barycentric coordinates of the support points of the unknowns (m x 3). An unknown
  /// of an affine function is its value there. Where the unknowns are values, basis function i is 1
  /// at row i and 0 at the others.
  virtual Eigen::MatrixX3d support_points() const = 0;
  /// Returns the functional of local unknown i. Functional i is 1 at basis function i and 0 at the
  /// others. By default it is the value at support point i.
  virtual DofFunctional functional(int i) const {
    return {support_points().row(i), Eigen::VectorXd::Ones(1)};
  }
  /// Returns the coefficients (m) of a linear equation that the m unknowns of each triangle satisfy
  /// in V_h. Empty: there is none. A model appends these equations to its problem, or refuses the
  /// element.
  virtual Eigen::VectorXd equation() const { return {}; }
  virtual bool nodal() const { return true; }  ///< every unknown is the value at its support point
  /// Returns the m values of the basis at lambda.
  virtual Eigen::VectorXd basis(const Eigen::Vector3d& lambda) const = 0;
  /// Returns the derivatives d phi_i / d lambda_j (m x 3). The gradients of the basis functions are
  /// the product of this matrix and the matrix grad lambda (3 x 2). For hybrid_bdm1 that product is
  /// the L2 projection of the gradient on affine functions.
  virtual Eigen::MatrixX3d derivative(const Eigen::Vector3d& lambda) const = 0;

  /// Returns m.
  int dofs() const { return 3 * dofs_per_vertex() + 3 * dofs_per_edge() + dofs_per_cell(); }
};

/// Returns the mean of every basis function of the element over the edge opposite local vertex i.
/// The means are exact.
Eigen::VectorXd means_on_edge(const Element& element, int i);

/// The elements. Each is one instance that lives as long as the program. P1 to P4 are conforming.
/// From P2 on the contact condition holds only at the unknowns on Gamma_C, the contact boundary, so
/// K_h, the admissible set of the discrete problem, is not a subset of K. CR is Crouzeix-Raviart's
/// nonconforming P1 element of Section 4.2 of [SR04] (cited in problem/variational_inequality.hpp),
/// with its unknowns at edge midpoints. p1_bubble is P1 with a bubble per triangle. Its functions
/// are affine on every edge. P1dc, discontinuous P1, is affine on each triangle without any
/// continuity: its three unknowns of a triangle are the values at the midpoints of its edges, and
/// no unknown is shared. It needs a form that couples triangles (form/interior_penalty.hpp).
/// hybrid_bdm1 is nonconforming, of order 2. Its unknowns are weighted means of u, two on each edge
/// and one on the triangle (space/hybrid_bdm1.cpp). fortin_soulie is the same with one equation per
/// triangle: nonconforming P2 (space/fortin_soulie.cpp). It is for plane strain.
const Element& p1();
const Element& p2();
const Element& p3();
const Element& p4();
const Element& crouzeix_raviart();
const Element& p1_bubble();
const Element& discontinuous_p1();
const Element& hybrid_bdm1();
const Element& fortin_soulie();
/// Returns one of P1 to P6 by its degree. Throws Error for another degree.
const Element& lagrange(int degree);
/// Returns an element by its name, "P1" to "P6", "CR", "P1+bubble" or "BDM1-hybrid" (for short
/// "M2"). Throws Error for another name.
const Element& element(const std::string& name);

}  // namespace antilock
