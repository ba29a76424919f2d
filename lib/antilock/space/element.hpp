#pragma once
#include <Eigen/Core>
#include <array>
#include <string>

#include "antilock/core/eigen_memory.hpp"
#include "antilock/mesh/cell_kind.hpp"

namespace antilock {

/// A degree of freedom as a functional of a function v on a cell, sum_q weights_q v(points_q). It
/// is the value at one point, or a weighted mean by a quadrature rule. The weights sum to 1.
struct DofFunctional {
  ReferencePoints points;   ///< q x c
  Eigen::VectorXd weights;  ///< q
};

/// The points at which the forms of an element of quadrilaterals are evaluated.
enum class Integration {
  full,       ///< two by two Gauss points
  selective,  ///< the centre of the cell for the rows of B, two by two points for A1
  reduced,    ///< the centre of the cell for both
};

/// A finite element on the reference cell of its kind: its m unknowns, their support points and its
/// basis, in the coordinates xi of the cell. The local order of the unknowns is: vertices, edges,
/// in space the faces, the interior, each in the order of the cell.
class Element {
 public:
  explicit Element(CellKind kind = CellKind::triangle) : kind_(kind) {}
  virtual ~Element() = default;
  CellKind kind() const { return kind_; }
  virtual std::string name() const = 0;
  /// Returns k: the derivatives have degree k - 1 on a simplex, and the quadrature of forms and
  /// loads follows from k.
  virtual int degree() const = 0;
  virtual int basis_degree() const { return degree(); }  ///< the polynomial degree of the basis
  /// Returns the degree of the rule for A1 (gradient_quadrature). By default the rule is exact for
  /// the product of two derivatives, of degree 2 (k - 1) on a simplex. On a square a derivative by
  /// s is of degree k in t. So there the degree is 2 k in s and in t.
  virtual int gradient_degree() const {
    return 2 * (reference_cell(kind_).simplex ? degree() - 1 : degree());
  }
  /// Returns the degree of the rule for the rows of B (strain_quadrature).
  virtual int strain_degree() const { return gradient_degree(); }
  virtual bool conforming() const { return true; }  ///< V_h is a subspace of V: no jumps
  virtual int dofs_per_vertex() const = 0;          ///< unknowns at a vertex
  /// Unknowns on an edge, ordered from its first vertex to its second one.
  virtual int dofs_per_edge() const = 0;
  virtual int dofs_per_face() const { return 0; }  ///< unknowns on a face of a tetrahedron, 0 or 1
  virtual int dofs_per_cell() const = 0;           ///< unknowns inside a cell
  /// Returns the support points of the unknowns (m x c). An unknown of an affine function is its
  /// value there. Where the unknowns are values, basis function i is 1 at row i and 0 at the
  /// others.
  virtual ReferencePoints support_points() const = 0;
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
  /// Returns the m values of the basis at xi.
  virtual Eigen::VectorXd basis(const ReferencePoint& xi) const = 0;
  /// Returns the derivatives d phi_i / d xi_j (m x c). The gradients of the basis functions are the
  /// product of this matrix and the matrix of the gradients of xi (c x d). For hybrid_bdm1 that
  /// product is the L2 projection of the gradient on affine functions.
  virtual ReferencePoints derivative(const ReferencePoint& xi) const = 0;

  /// Returns m.
  int dofs() const {
    const ReferenceCell& cell = reference_cell(kind_);
    const int on_faces = cell.dimension == 3 ? cell.facets * dofs_per_face() : 0;
    return cell.vertices * dofs_per_vertex() + cell.edges * dofs_per_edge() + on_faces +
           dofs_per_cell();
  }
  /// Returns the unknowns inside a facet: those of an edge in the plane, those of a face in space.
  int dofs_per_facet() const {
    return reference_cell(kind_).dimension == 2 ? dofs_per_edge() : dofs_per_face();
  }

 private:
  CellKind kind_;
};

/// Returns the mean of every basis function of the element over facet i. The means are exact.
Eigen::VectorXd means_on_facet(const Element& element, int i);

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
/// triangle: nonconforming P2 (space/fortin_soulie.cpp). It is for plane strain. q1 is bilinear on
/// the reference square. P1 and CR are elements of triangles or of tetrahedra, and so is P2. The
/// last three are of quadrilaterals, and all others of triangles.
///
/// q1 has its name and an integration: "Q1", "Q1-selective" or "Q1-reduced". rotated_q1 is the
/// nonconforming element of Rannacher and Turek. Its unknowns are means over edges.
/// rotated_q1_plus has one more unknown per cell, and contains the affine functions on each
/// quadrilateral (space/rotated_q1.cpp).
const Element& p1(CellKind kind = CellKind::triangle);
const Element& p2(CellKind kind = CellKind::triangle);
const Element& p3();
const Element& p4();
const Element& crouzeix_raviart(CellKind kind = CellKind::triangle);
const Element& p1_bubble();
const Element& discontinuous_p1();
const Element& hybrid_bdm1();
const Element& fortin_soulie();
const Element& q1(Integration integration = Integration::full);
const Element& rotated_q1();
const Element& rotated_q1_plus();
/// Returns one of P1 to P6 by its degree, on tetrahedra P1 or P2. Throws Error for another degree,
/// and for quadrilaterals.
const Element& lagrange(int degree, CellKind kind = CellKind::triangle);
/// Returns an element of a kind by its name: on triangles "P1" to "P6", "CR", "P1+bubble" or
/// "BDM1-hybrid" (for short "M2"), on tetrahedra "P1", "P2" or "CR", and on quadrilaterals "Q1",
/// "Q1-selective", "Q1-reduced", "Q1rot" or "Q1rot+". Throws Error for another name.
const Element& element(const std::string& name, CellKind kind = CellKind::triangle);

}  // namespace antilock
