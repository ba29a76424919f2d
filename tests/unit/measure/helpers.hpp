#pragma once
#include <Eigen/Core>

#include "antilock/form/gradient_forms.hpp"
#include "antilock/measure/residual.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/space/space.hpp"

namespace antilock::test::measure_test {

using Meshes = std::vector<TriangleMesh>;

inline std::vector<const Element*> elements() {
  return {&p1(), &p2(), &p3(), &p4(), &crouzeix_raviart()};
}

/// u = 0.2 + 3 x - 2 y, exactly in every space; layer stress -2 / epsilon^2.
inline Reference affine(double epsilon) {
  return {[](double x, double y) { return 0.2 + 3 * x - 2 * y; },
          [](double, double) { return Eigen::Vector2d(3, -2); },
          [epsilon](double, double) { return -2 / (epsilon * epsilon); }};
}

inline Solution interpolant(const Space& space, const Reference& reference, double epsilon) {
  Solution s;
  s.u.resize(space.size());
  for (int i = 0; i < space.size(); ++i)
    s.u(i) = reference.value(space.dof_coordinates()(i, 0), space.dof_coordinates()(i, 1));
  s.p = layer_strain(space).b * s.u / (epsilon * epsilon);
  return s;
}

}  // namespace antilock::test::measure_test
