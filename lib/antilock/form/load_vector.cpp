#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/form/forms.hpp"

namespace antilock {

const Quadrature& load_rule(const Element& element) { return triangle_rule(std::max(5, 2 * element.degree())); }

Eigen::VectorXd load_vector(const Space& space, const Field& f, Region region) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = load_rule(space.element());
  const Eigen::Matrix3Xd points = rule.points.transpose();
  Eigen::MatrixXd weighted(space.element().unknowns(), points.cols());  // the basis at the points, times their weights
  for (Eigen::Index q = 0; q < points.cols(); ++q)
    weighted.col(q) = rule.weights(q) * space.element().basis(points.col(q));
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.size()), values(points.cols()), local(weighted.rows());
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
    for (Eigen::Index i = 0; i < local.size(); ++i) load(space.unknowns()(t, i)) += local(i);
  }
  return load;
}

}  // namespace antilock
