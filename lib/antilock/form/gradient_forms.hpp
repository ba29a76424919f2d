#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "antilock/form/factored_form.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// The stiffness of a region: the form is int k_x (d_x u) (d_x v) + k_y (d_y u) (d_y v), where k_x
/// is the member x, and k_y the member y. In space the layer has two directions. There the form is
/// int k_x (d_x u d_x v + d_y u d_y v) + k_y d_z u d_z v.
struct Stiffness {
  double x = 1, y = 1;
};

/// Returns the stiffness of a triangle of the body: the value of `of_body` at the centroid, and 1
/// where `of_body` is empty. Throws Error where it is not positive.
double stiffness_on(const Field& of_body, const TriangleMesh& mesh, int triangle);

/// Returns the N x N matrix of the form, summed over the triangles. The stiffness {1, 1} on the
/// body gives the form a+ of (23) of [SR04] (cited in problem/variational_inequality.hpp), and {1,
/// 0} on the layer gives a_x^-.
Eigen::SparseMatrix<double> gradient_form(const Space& space, const Stiffness& body,
                                          const Stiffness& layer);
/// Returns the same for a stiffness per triangle (T).
Eigen::SparseMatrix<double> gradient_form(const Space& space,
                                          const std::vector<Stiffness>& of_triangle);
/// Returns the same form in factors. The rows of B are d_x and d_y at each point of
/// gradient_quadrature; those of stiffness 0 are left out.
WeightedFactoredForm gradient_rows(const Space& space, const std::vector<Stiffness>& of_triangle);

/// Returns the form that stabilises Q1 with one point per cell (D. P. Flanagan and T. Belytschko,
/// Int. J. Numer. Methods Eng. 17, 1981). There is one row per quadrilateral, in the order of the
/// cells. It is the hourglass part of u: with the corner values u_i, the corners x_i,
/// h = (1, -1, 1, -1) and the gradient at the centre
///
///     h . u / 4 - (h . x / 4) . grad u(centre),
///
/// which is 0 for affine functions and has the unit of u. Its entry of M is the energy of the
/// function S T, S = 2 s - 1 and T = 2 t - 1, in the form with these stiffnesses. The reduced form
/// and this form together are the full form on any convex quadrilateral. Throws Error for another
/// element than one of Q1.
FactoredForm hourglass_form(const Space& space, const Stiffness& body, const Stiffness& layer);

/// Returns the factored form of a_y^-(u, v) = (B u, M B v) of (23). A row of B is d_y, in space
/// d_z, at a quadrature point of a layer triangle, and M holds the weight of the point times the
/// area. For P1 and CR d_y u is constant on a triangle, so there is one row per triangle.
/// `direction`, if not empty, returns the direction that replaces y on a triangle. It is used in
/// the plane alone.
FactoredForm layer_strain(const Space& space,
                          const std::function<Eigen::Vector2d(int triangle)>& direction = {});
/// Returns the quadrature rule of these rows. For an element of degree k, d/dy u_h has degree k - 1
/// on a triangle, and its square degree 2 (k - 1). So the rule is the centroid for k = 1 and the
/// edge midpoints for k = 2. On quadrilaterals it follows from
/// Element::strain_degree.
const Quadrature& strain_quadrature(const Element& element);
/// Returns the quadrature rule of gradient_form and gradient_rows. It is strain_quadrature but for
/// Q1-selective.
const Quadrature& gradient_quadrature(const Element& element);

/// Returns the N values of int f phi_i over the body, or over the layer, by load_rule.
Eigen::VectorXd load_vector(const Space& space, const Field& f, Region region = Region::body);

/// Returns the load that works on the means alone (N): v -> sum_T v_T int_T f, with v_T the mean of
/// v over T and int_T f by `rule`. It is for hybrid_bdm1. With this load the flux of the solution
/// is in equilibrium with the mean of f on each triangle (tutorials/guides/order_two.md). Throws
/// Error for an element without that unknown, and where f is not finite.
Eigen::VectorXd mean_load_vector(const Space& space, const Field& f, Region region = Region::body,
                                 const Quadrature& rule = triangle_rule(8));

/// Returns a rule of degree 5, or of degree 2 k for an element of degree k > 2, so that the
/// quadrature error is smaller than the error of the element.
const Quadrature& load_rule(const Element& element);

}  // namespace antilock
