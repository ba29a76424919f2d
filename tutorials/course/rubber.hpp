#pragma once
#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "antilock/analysis/kernel.hpp"
#include "antilock/form/elasticity_forms.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/plane_strain.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock::tutorial {

// The functions that chapters 26 and 30 share.

/// A discretisation: triangles, an element per component, whether the jumps at edges are
/// penalised, and whether it locks.
struct Rubber {
  std::string name, file;
  TriangleMesh mesh;
  const Element &in_x, &in_y;
  bool jumps, locks;
};

/// Returns four discretisations on n x n squares with free sides, n = `cells`.
inline std::vector<Rubber> structured_rubbers(int cells) {
  const TriangleMesh right = with_free_sides(structured_mesh(cells, Domain{0}));
  const TriangleMesh crossed =
      with_free_sides(structured_mesh(cells, Domain{0}, Diagonal::crossed));
  return {{"P1 right diagonals", "p1_right", right, p1(), p1(), false, true},
          {"P1 crossed triangles", "p1_crossed", crossed, p1(), p1(), false, false},
          {"Crouzeix-Raviart with jumps", "cr", right, crouzeix_raviart(),
           crouzeix_raviart(), true, false},
          {"Kouhia-Stenberg", "ks", right, p1(), crouzeix_raviart(), false, false}};
}

/// Returns these four and P1 on gmsh's triangles of the same size.
inline std::vector<Rubber> rubbers(int cells) {
  const TriangleMesh any = with_free_sides(unstructured_mesh(cells, Domain{0}));
  std::vector<Rubber> all;
  for (const Rubber& rubber : structured_rubbers(cells)) {
    all.push_back(rubber);
    if (rubber.locks)
      all.push_back({"P1 unstructured", "p1_unstructured", any, p1(), p1(), false, true});
  }
  return all;
}

/// Returns the largest difference of the solution from the uniform strain
/// u = (.1/(1 + 2 epsilon) x, -.1 y), which is in every space and is the exact solution.
inline double patch_error(const Rubber& rubber, double epsilon) {
  const Space x(rubber.mesh, rubber.in_x), y(x, rubber.in_y);
  PlaneStrain scene;  // flat obstacle, touching
  scene.epsilon = epsilon;
  scene.sliding = true;
  scene.jump_weight = rubber.jumps ? 1 : 0;
  const Eigen::VectorXd u = active_set(assemble(scene, {x, y})).u;
  const Eigen::VectorXd in_x =
      u.head(x.size()) - 0.1 / (1 + 2 * epsilon) * x.dof_coordinates().col(0);
  return std::max(
      in_x.cwiseAbs().maxCoeff(),
      (u.tail(y.size()) + 0.1 * y.dof_coordinates().col(1)).cwiseAbs().maxCoeff());
}

/// Returns the dimension of the kernel of a1 on the free unknowns: the motions without
/// energy.
inline int zero_modes(VariationalInequality problem) {
  problem.b = problem.a1;
  problem.m = Eigen::VectorXd::Ones(problem.size());
  return kernel_dimension(problem);
}

/// Returns the mean outward displacement of the side x = `side`, 0 or 1.
inline double bulge(const Space& space, const Eigen::VectorXd& u, double side) {
  const TriangleMesh& mesh = space.mesh();
  double mean = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int e = mesh.triangle_edges(t, i);
      if (mesh.vertices(mesh.edges(e, 0), 0) != side ||
          mesh.vertices(mesh.edges(e, 1), 0) != side)
        continue;
      const Eigen::VectorXd at_midpoint =
          space.element().basis(0.5 * (Eigen::Vector3d::Ones() - Eigen::Vector3d::Unit(i)));
      const Eigen::VectorXi unknowns = space.cell_dofs().row(t);
      mean += mesh.edge_length(e) * at_midpoint.dot(u(unknowns));
    }
  return side == 0 ? -mean : mean;
}

/// Returns by how many per cent a contact force is too large, or NaN where the exact force
/// is not known. The reference is the force of Taylor-Hood elements on graded meshes
/// (freefem/26_elasticity.edp) at epsilon = 1, 1e-2, 1e-4 and <= 1e-8.
inline double percent_too_large(double force, double epsilon) {
  static const std::map<double, double> reference{
      {1, 0.158792}, {1e-2, 0.255738}, {1e-4, 0.259131}, {1e-8, 0.259166}, {0, 0.259166}};
  const auto known = reference.find(epsilon < 1e-8 ? 0 : epsilon);
  return known == reference.end() ? std::numeric_limits<double>::quiet_NaN()
                                  : 100 * (force / known->second - 1);
}

}  // namespace antilock::tutorial
