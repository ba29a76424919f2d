#include <fmt/format.h>

#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/form/detail/sparse_assembly.hpp"
#include "antilock/form/forms.hpp"
#include "antilock/form/quadrature.hpp"

namespace antilock {

double stiffness_on(const Field& of_body, const TriangleMesh& mesh, int triangle) {
  if (!of_body) return 1;
  const Eigen::Vector2d x = point_in(mesh, triangle, Eigen::Vector3d::Constant(1.0 / 3));
  const double factor = of_body(x(0), x(1));
  if (!(factor > 0 && std::isfinite(factor)))
    throw Error(fmt::format("stiffness({:.6g}, {:.6g}) = {}; accepted: a positive number", x(0), x(1), factor));
  return factor;
}

Eigen::SparseMatrix<double> gradient_form(const Space& space, const Stiffness& body, const Stiffness& layer,
                                          const Field& of_body) {
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  const auto weight = [&](int t) -> Stiffness {
    if (mesh.region[t] == Region::layer) return layer;
    const double factor = stiffness_on(of_body, mesh, t);
    return {factor * body.x, factor * body.y};
  };

  if (element.degree() == 1) {
    // the gradients are constant on a triangle: one point is exact
    const Eigen::Matrix3d derivative = element.derivative(Eigen::Vector3d::Constant(1.0 / 3));
    return sum_element_matrices(space, [&](int t) -> Eigen::Matrix3d {
      const Eigen::Matrix<double, 3, 2> gradient = derivative * barycentric_gradients(mesh, t);
      const double area = mesh.area(t);
      const Stiffness stiffness = weight(t);
      return area * stiffness.x * gradient.col(0) * gradient.col(0).transpose() +
             area * stiffness.y * gradient.col(1) * gradient.col(1).transpose();
    });
  }
  const Quadrature& rule = triangle_rule(2 * (element.degree() - 1));
  std::vector<Eigen::MatrixX3d> derivative;
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) derivative.push_back(element.derivative(rule.points.row(q)));
  return sum_element_matrices(space, [&](int t) -> Eigen::MatrixXd {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(element.unknowns(), element.unknowns());
    const Eigen::Matrix<double, 3, 2> lambda = barycentric_gradients(mesh, t);
    const Stiffness stiffness = weight(t);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::MatrixX2d gradient = derivative[q] * lambda;
      const double w = rule.weights(q) * mesh.area(t);
      matrix += w * stiffness.x * gradient.col(0) * gradient.col(0).transpose() +
                w * stiffness.y * gradient.col(1) * gradient.col(1).transpose();
    }
    return matrix;
  });
}

}  // namespace antilock
