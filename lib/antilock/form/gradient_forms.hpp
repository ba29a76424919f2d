#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "antilock/form/factored_form.hpp"
#include "antilock/form/quadrature.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Stiffness in x and in y of a region: the form is the integral of x d/dx u d/dx v + y d/dy u d/dy v.
struct Stiffness {
  double x = 1, y = 1;
};

/// The factor that `of_body` is on a triangle of the body: its value at the centroid; 1 where it is empty. Throws Error
/// where it is not positive.
double stiffness_on(const Field& of_body, const TriangleMesh& mesh, int triangle);

/// N x N matrix of the sum over the triangles of  int stiffness.x d/dx u d/dx v + stiffness.y d/dy u d/dy v.
/// The forms a+ and a_x^- of (23) are {1, 1} on the body and {1, 0} on the layer.
Eigen::SparseMatrix<double> gradient_form(const Space& space, const Stiffness& body, const Stiffness& layer);
/// The same with a stiffness of each triangle (T).
Eigen::SparseMatrix<double> gradient_form(const Space& space, const std::vector<Stiffness>& of_triangle);
/// The same as rows: d/dx and d/dy at each point of strain_quadrature, where that stiffness is above 0.
WeightedFactoredForm gradient_rows(const Space& space, const std::vector<Stiffness>& of_triangle);

/// The factored form of a_y^-(u, v) = (B u, M B v), (23): a row of B is d/dy at a quadrature point of a layer triangle,
/// M its weight. For P1 and CR d/dy is constant on a triangle: one row each, M its area. `direction`: of a triangle, another
/// than y.
FactoredForm layer_strain(const Space& space, const std::function<Eigen::Vector2d(int triangle)>& direction = {});
/// The rule behind the rows of B, a triangle: d/dy u_h is of degree k - 1 and is squared, so 2 (k - 1): the centroid
/// for degree 1, the edge midpoints for degree 2.
const Quadrature& strain_quadrature(const Element& element);

/// N values of (f, phi_i) over the body, or over the layer, by load_rule.
Eigen::VectorXd load_vector(const Space& space, const Field& f, Region region = Region::body);

/// Of degree 5, or 2 k for an element of degree k > 2: what it leaves out is smaller than the error of the element.
const Quadrature& load_rule(const Element& element);

}  // namespace antilock
