#include "common/by_hand.hpp"

#include "antilock/form/quadrature.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock::tutorial {

void add_loads(Eigen::VectorXd& load, const Eigen::RowVector3i& vertices, const Corners& corners, double area) {
  for (Eigen::Index q = 0; q < radon_rule().weights.size(); ++q) {
    const Eigen::Vector3d lambda = radon_rule().points.row(q);
    const double x = lambda(0) * corners(0, 0) + lambda(1) * corners(1, 0) + lambda(2) * corners(2, 0);
    load(vertices) += area * radon_rule().weights(q) * paper_load(x, 0) * lambda;
  }
}

}  // namespace antilock::tutorial
