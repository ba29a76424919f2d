#include "antilock/form/quadrature.hpp"

#include <cmath>

namespace antilock {

const Quadrature& radon_rule() {
  static const Quadrature rule = [] {
    // J. Radon, Zur mechanischen Kubatur, 1948
    const double s = std::sqrt(15.0), a = (6 - s) / 21, b = (6 + s) / 21;
    Quadrature q;
    q.points.resize(7, 3);
    q.points << 1.0 / 3, 1.0 / 3, 1.0 / 3, 1 - 2 * a, a, a, a, 1 - 2 * a, a, a, a, 1 - 2 * a, 1 - 2 * b, b, b, b,
        1 - 2 * b, b, b, b, 1 - 2 * b;
    q.weights.resize(7);
    q.weights << 9.0 / 40, Eigen::Vector3d::Constant((155 - s) / 1200), Eigen::Vector3d::Constant((155 + s) / 1200);
    return q;
  }();
  return rule;
}

const Quadrature& midpoint_rule() {
  static const Quadrature rule{0.5 * (Eigen::Matrix3d::Ones() - Eigen::Matrix3d::Identity()),
                               Eigen::Vector3d::Constant(1.0 / 3)};
  return rule;
}

}  // namespace antilock
