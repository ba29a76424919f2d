#pragma once
#include <algorithm>
#include <functional>

#include "backstage/30_friction.hpp"

namespace antilock::tutorial {

/// The load of a force per length on one component, on all edges of the boundary.
inline Eigen::VectorXd boundary_load(const Space& space, const std::function<double(const Eigen::Vector2d&)>& force) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(space.size());
  const TriangleMesh& mesh = space.mesh();
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int e = mesh.triangle_edges(t, i);
      if (mesh.edge_triangles(e, 1) >= 0) continue;
      const Eigen::Vector3d midpoint = 0.5 * (Eigen::Vector3d::Ones() - Eigen::Vector3d::Unit(i));
      const Eigen::VectorXi unknowns = space.unknowns().row(t);
      load(unknowns) += mesh.edge_length(e) * force(point_in(mesh, t, midpoint)) * space.element().basis(midpoint);
    }
  return load;
}

/// The largest error of u in a patch test with friction and slip, which elements that hold affine functions pass: the unit
/// square is pressed by 0.1 on a flat floor with g = 0.1, its left side is dragged to the right, and everything slips,
/// u = (0.05 + a x + g y, -0.1 y), a = 0.1 / (1 + 2 epsilon). Top and sides get their share of g as a load.
inline double slipping_patch_error(const VectorSpace& space, double jump_weight, double epsilon) {
  constexpr double rubs = 0.1, slip = 0.05;
  const Space &x = space.x, &y = space.y;
  PlaneStrain scene;  // flat obstacle, touching
  scene.epsilon = epsilon;
  scene.sliding = true;
  scene.friction = [](double) { return rubs; };
  scene.jump_weight = jump_weight;
  VariationalInequality problem = assemble(scene, space);
  const Eigen::VectorXd exact =
      slip + 0.1 / (1 + 2 * epsilon) * x.points().col(0).array() + rubs * x.points().col(1).array();
  for (std::size_t i = 0; i < problem.fixed.size(); ++i)
    if (problem.fixed[i] < x.size()) problem.fixed_values(static_cast<Eigen::Index>(i)) = exact(problem.fixed[i]);
  problem.load.head(x.size()) = boundary_load(x, [](const auto& at) { return at(1) == 1 ? rubs : 0; });
  problem.load.tail(y.size()) = boundary_load(y, [](const auto& at) {
    return at(0) == 1 ? rubs : at(0) == 0 ? -rubs : 0;
  });
  const Eigen::VectorXd u = active_set(problem).u;
  return std::max((u.head(x.size()) - exact).cwiseAbs().maxCoeff(),
                  (u.tail(y.size()) + 0.1 * y.points().col(1)).cwiseAbs().maxCoeff());
}

/// One row per element that does not lock: patch, g = 0 and g = 1e6 as above; steps and seconds of the active set, then of
/// Uzawa, and the largest difference of their displacements.
inline const std::vector<std::string> check_columns{"element", "unknowns",    "patch",   "g = 0",   "g = 1e6",
                                                    "steps",   "Uzawa steps", "seconds", "Uzawa s", "apart"};
inline std::vector<Entry> check_row(const Rubber& rubber, const VectorSpace& space,
                                    const std::function<VariationalInequality(const Profile& g)>& pressed,
                                    double epsilon, const Solution& solution, double seconds, const Solution& same,
                                    double seconds_of_uzawa) {
  const auto [none, bonded] = extremes_of_friction(pressed);
  return {rubber.name,
          solution.counters.unknowns,
          slipping_patch_error(space, rubber.jumps ? 1 : 0, epsilon),
          none,
          bonded,
          solution.counters.contact,
          same.counters.contact,
          seconds,
          seconds_of_uzawa,
          (same.u - solution.u).cwiseAbs().maxCoeff()};
}

}  // namespace antilock::tutorial
