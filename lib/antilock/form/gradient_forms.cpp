// The forms of (23), integrals of products of gradients; its load; the norm.
#include "antilock/form/gradient_forms.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/form/factored_form.hpp"
#include "antilock/form/sparse_assembly.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"

namespace antilock {
namespace {

std::vector<Eigen::MatrixX3d> derivatives_at(const Element& element, const Quadrature& rule) {
  std::vector<Eigen::MatrixX3d> derivatives;
  for (const auto point : rule.points.rowwise()) derivatives.push_back(element.derivative(point));
  return derivatives;
}

}  // namespace

double stiffness_on(const Field& of_body, const TriangleMesh& mesh, int triangle) {
  if (!of_body) return 1;
  const Eigen::Vector2d x = point_in(mesh, triangle, Eigen::Vector3d::Constant(1.0 / 3));
  const double factor = of_body(x(0), x(1));
  if (!(factor > 0 && std::isfinite(factor)))
    throw Error(fmt::format("stiffness({:.6g}, {:.6g}) = {}; accepted: a positive number", x(0),
                            x(1), factor));
  return factor;
}

const Quadrature& strain_quadrature(const Element& element) {
  return triangle_rule(2 * (element.degree() - 1));
}

Eigen::SparseMatrix<double> gradient_form(const Space& space, const Stiffness& body,
                                          const Stiffness& layer) {
  std::vector<Stiffness> of_triangle;
  for (const Region region : space.mesh().region)
    of_triangle.push_back(region == Region::layer ? layer : body);
  return gradient_form(space, of_triangle);
}

Eigen::SparseMatrix<double> gradient_form(const Space& space,
                                          const std::vector<Stiffness>& of_triangle) {
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  const Quadrature& rule = strain_quadrature(element);
  const std::vector<Eigen::MatrixX3d> derivatives = derivatives_at(element, rule);
  const auto add = [](auto& matrix, double weight, const Stiffness& stiffness,
                      const auto& gradient) {
    matrix += weight * stiffness.x * gradient.col(0) * gradient.col(0).transpose() +
              weight * stiffness.y * gradient.col(1) * gradient.col(1).transpose();
  };
  if (element.degree() == 1) {  // one point, matrices of a fixed size
    const Eigen::Matrix3d derivative = derivatives[0];
    return assemble_cells(space, [&](int t) {
      const Eigen::Matrix<double, 3, 2> gradient = derivative * barycentric_gradients(mesh, t);
      Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
      add(matrix, mesh.area(t), of_triangle[t], gradient);
      return matrix;
    });
  }
  return assemble_cells(space, [&](int t) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(element.dofs(), element.dofs());
    const Eigen::Matrix<double, 3, 2> lambda = barycentric_gradients(mesh, t);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
      add(matrix, rule.weights(q) * mesh.area(t), of_triangle[t],
          Eigen::MatrixX2d(derivatives[q] * lambda));
    return matrix;
  });
}

WeightedFactoredForm gradient_rows(const Space& space, const std::vector<Stiffness>& of_triangle) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = strain_quadrature(space.element());
  const std::vector<Eigen::MatrixX3d> derivatives = derivatives_at(space.element(), rule);
  FactoredFormBuilder rows;
  std::vector<double> moduli;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Matrix<double, 3, 2> lambda = barycentric_gradients(mesh, t);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
      for (int axis = 0; axis < 2; ++axis) {
        const double modulus = axis == 0 ? of_triangle[t].x : of_triangle[t].y;
        if (!(modulus > 0)) continue;
        rows.add(t, rule.weights(q) * mesh.area(t));
        moduli.push_back(modulus);
        const Eigen::VectorXd derivative = derivatives[q] * lambda.col(axis);
        for (Eigen::Index i = 0; i < derivative.size(); ++i)
          rows.put(space.cell_dofs()(t, i), derivative(i));
      }
  }
  return {rows.form(space.size()),
          Eigen::Map<const Eigen::VectorXd>(moduli.data(), Eigen::Index(moduli.size()))};
}

FactoredForm layer_strain(const Space& space,
                          const std::function<Eigen::Vector2d(int)>& direction) {
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  const Quadrature& rule = strain_quadrature(element);
  const auto points = rule.weights.size();
  const std::vector<Eigen::MatrixX3d> derivatives = derivatives_at(element, rule);
  Eigen::VectorXd dy(element.dofs());
  FactoredForm strain;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::layer) strain.cell.insert(strain.cell.end(), points, t);
  const auto rows = static_cast<Eigen::Index>(strain.cell.size());
  strain.m.resize(rows);
  strain.b.resize(rows, space.size());
  strain.b.reserve(Eigen::VectorXi::Constant(rows, element.dofs()));
  for (Eigen::Index r = 0; r < rows; ++r) {
    const int t = strain.cell[r];
    const Eigen::Index q = r % points;
    strain.m(r) = rule.weights(q) * mesh.area(t);
    const Eigen::Matrix<double, 3, 2> lambda = barycentric_gradients(mesh, t);
    const Eigen::Vector3d slope =
        direction ? Eigen::Vector3d(lambda * direction(t)) : Eigen::Vector3d(lambda.col(1));
    dy.noalias() = derivatives[q] * slope;
    for (Eigen::Index i = 0; i < dy.size(); ++i)
      strain.b.insert(r, space.cell_dofs()(t, i)) = dy(i);
  }
  strain.b.makeCompressed();
  return strain;
}

const Quadrature& load_rule(const Element& element) {
  return triangle_rule(std::max(5, 2 * element.degree()));
}

Eigen::VectorXd mean_load_vector(const Space& space, const Field& f, Region region,
                                 const Quadrature& rule) {
  const Element& element = space.element();
  if (element.nodal() || element.dofs_per_cell() != 1)
    throw Error("load on the means: element " + element.name() +
                " has no mean per triangle; accepted: BDM1-hybrid (hybrid_bdm1)");
  const TriangleMesh& mesh = space.mesh();
  const int mean = element.dofs() - 1;  // the unknown of the triangle is the last one
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.size());
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != region) continue;
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
      const double value = f(x(0), x(1));
      if (!std::isfinite(value))
        throw Error(fmt::format("load: f({:.6g}, {:.6g}) is not finite", x(0), x(1)));
      load(space.cell_dofs()(t, mean)) += mesh.area(t) * rule.weights(q) * value;
    }
  }
  return load;
}

Eigen::VectorXd load_vector(const Space& space, const Field& f, Region region) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = load_rule(space.element());
  const Eigen::Matrix3Xd points = rule.points.transpose();
  Eigen::MatrixXd weighted(space.element().dofs(),
                           points.cols());  // the basis at the points, times their weights
  for (Eigen::Index q = 0; q < points.cols(); ++q)
    weighted.col(q) = rule.weights(q) * space.element().basis(points.col(q));
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.size()), values(points.cols()),
                  local(weighted.rows());
  Eigen::Matrix<double, 2, 3> corners;
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> x(2, points.cols());
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != region) continue;
    for (int i = 0; i < 3; ++i) corners.col(i) = mesh.vertices.row(mesh.triangles(t, i));
    x = corners.lazyProduct(points);
    for (Eigen::Index q = 0; q < values.size(); ++q) {
      values(q) = f(x(0, q), x(1, q));
      if (!std::isfinite(values(q)))
        throw Error(fmt::format("load: f({:.6g}, {:.6g}) is not finite", x(0, q), x(1, q)));
    }
    local.noalias() = mesh.area(t) * weighted.lazyProduct(values);
    for (Eigen::Index i = 0; i < local.size(); ++i) load(space.cell_dofs()(t, i)) += local(i);
  }
  return load;
}

}  // namespace antilock
