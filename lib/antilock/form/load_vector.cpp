#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/form/forms.hpp"
#include "antilock/form/quadrature.hpp"

namespace antilock {

const Quadrature& load_rule(const Element& element) { return triangle_rule(std::max(5, 2 * element.degree())); }

Eigen::VectorXd load_vector(const Space& space, const Field& f, Region region) {
  const TriangleMesh& mesh = space.mesh();
  const Quadrature& rule = load_rule(space.element());
  Eigen::MatrixXd basis(space.element().unknowns(), rule.weights.size());
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) basis.col(q) = space.element().basis(rule.points.row(q));
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.size());
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.region[t] != region) continue;
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector2d x = point_in(mesh, t, rule.points.row(q));
      const double value = f(x(0), x(1));
      if (!std::isfinite(value)) throw Error(fmt::format("load: f({:.6g}, {:.6g}) is not finite", x(0), x(1)));
      const double weighted = rule.weights(q) * mesh.area(t) * value;
      for (Eigen::Index i = 0; i < basis.rows(); ++i) load(space.unknowns()(t, i)) += weighted * basis(i, q);
    }
  }
  return load;
}

}  // namespace antilock
