#pragma once
#include <algorithm>
#include <limits>
#include <map>

#include "antilock/analysis/kernel.hpp"
#include "antilock/solve/active_set.hpp"
#include "backstage/26_rubber.hpp"

namespace antilock::tutorial {

/// A uniform strain, u = (.1/(1 + 2 epsilon) x, -.1 y), is in every space: the largest difference of the solution from it.
inline double patch_error(const Rubber& rubber, double epsilon) {
  const Space x(rubber.mesh, rubber.in_x), y(rubber.mesh, rubber.in_y);
  PlaneStrain scene;  // flat obstacle, touching
  scene.epsilon = epsilon;
  scene.sliding = true;
  scene.jump_weight = rubber.jumps ? 1 : 0;
  const Eigen::VectorXd u = active_set(assemble(scene, {x, y})).u;
  const Eigen::VectorXd in_x = u.head(x.size()) - 0.1 / (1 + 2 * epsilon) * x.points().col(0);
  return std::max(in_x.cwiseAbs().maxCoeff(), (u.tail(y.size()) + 0.1 * y.points().col(1)).cwiseAbs().maxCoeff());
}

/// Dimension of the kernel of a1 on the free unknowns: the motions that cost no energy.
inline int zero_modes(VariationalInequality problem) {
  problem.b = problem.a1;
  problem.m = Eigen::VectorXd::Ones(problem.size());
  return kernel_dimension(problem);
}

/// How far the side x = `side`, 0 or 1, moves outwards on average.
inline double bulge(const Space& space, const Eigen::VectorXd& u, double side) {
  const TriangleMesh& mesh = space.mesh();
  double mean = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int e = mesh.triangle_edges(t, i);
      if (mesh.vertices(mesh.edges(e, 0), 0) != side || mesh.vertices(mesh.edges(e, 1), 0) != side) continue;
      const Eigen::VectorXd at_midpoint =
          space.element().basis(0.5 * (Eigen::Vector3d::Ones() - Eigen::Vector3d::Unit(i)));
      const Eigen::VectorXi unknowns = space.unknowns().row(t);
      mean += mesh.edge_length(e) * at_midpoint.dot(u(unknowns));
    }
  return side == 0 ? -mean : mean;
}

/// The contact force of Taylor-Hood on graded meshes (freefem/26_elasticity.edp), at epsilon = 1, 1e-2, 1e-4, <= 1e-8:
/// how much too large a force is, in per cent; 0 / 0 where it is not known.
inline double percent_too_large(double force, double epsilon) {
  static const std::map<double, double> reference{
      {1, 0.158792}, {1e-2, 0.255738}, {1e-4, 0.259131}, {1e-8, 0.259166}, {0, 0.259166}};
  const auto known = reference.find(epsilon < 1e-8 ? 0 : epsilon);
  return known == reference.end() ? std::numeric_limits<double>::quiet_NaN() : 100 * (force / known->second - 1);
}

}  // namespace antilock::tutorial
