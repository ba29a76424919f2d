#include "antilock/form/detail/sparse_assembly.hpp"
#include "antilock/form/forms.hpp"
#include "antilock/form/quadrature.hpp"

namespace antilock {

Eigen::SparseMatrix<double> gradient_form(const Space& space, const Stiffness& body, const Stiffness& layer) {
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  const auto weight = [&](int t) -> const Stiffness& { return mesh.region[t] == Region::body ? body : layer; };

  if (element.degree() == 1) {
    // the gradients are constant on a triangle: one point is exact
    const Eigen::Matrix3d derivative = element.derivative(Eigen::Vector3d::Constant(1.0 / 3));
    return sum_element_matrices(space, [&](int t) -> Eigen::Matrix3d {
      const Eigen::Matrix<double, 3, 2> gradient = derivative * barycentric_gradients(mesh, t);
      const double area = mesh.area(t);
      return area * weight(t).x * gradient.col(0) * gradient.col(0).transpose() +
             area * weight(t).y * gradient.col(1) * gradient.col(1).transpose();
    });
  }
  const Quadrature& rule = triangle_rule(2 * (element.degree() - 1));
  std::vector<Eigen::MatrixX3d> derivative;
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) derivative.push_back(element.derivative(rule.points.row(q)));
  return sum_element_matrices(space, [&](int t) -> Eigen::MatrixXd {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(element.unknowns(), element.unknowns());
    const Eigen::Matrix<double, 3, 2> lambda = barycentric_gradients(mesh, t);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::MatrixX2d gradient = derivative[q] * lambda;
      const double w = rule.weights(q) * mesh.area(t);
      matrix += w * weight(t).x * gradient.col(0) * gradient.col(0).transpose() +
                w * weight(t).y * gradient.col(1) * gradient.col(1).transpose();
    }
    return matrix;
  });
}

}  // namespace antilock
