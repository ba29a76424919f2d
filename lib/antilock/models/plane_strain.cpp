#include "antilock/models/plane_strain.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "antilock/core/error.hpp"
#include "antilock/form/averaged.hpp"

namespace antilock {

VariationalInequality assemble(const PlaneStrain& scene, const VectorSpace& space) {
  if (!(scene.epsilon >= 0 && scene.epsilon <= 1))
    throw Error(fmt::format("plane strain: epsilon = 1/lambda = {}; accepted 0 to 1", scene.epsilon));
  if (!std::isfinite(scene.push)) throw Error("plane strain: push is not finite");
  if (!(scene.jump_weight >= 0))
    throw Error(fmt::format("plane strain: jump weight {}; accepted 0 or more", scene.jump_weight));
  const int shift = space.x.size();
  VariationalInequality problem;
  problem.a1 = strain_form(space);
  if (scene.jump_weight > 0) problem.a1 += jump_form(space, scene.jump_weight, !scene.sliding);
  problem.a1.makeCompressed();
  FactoredForm div = divergence(space);
  if (scene.continuous_pressure) div = averaged(div, vertex_shares(space.x.mesh(), div, divergence_rule(space)));
  problem.b = std::move(div.b);
  problem.m = std::move(div.m);
  problem.compliance = scene.epsilon;
  problem.load = Eigen::VectorXd::Zero(space.size());

  std::map<int, double> fixed;
  for (const int i : space.x.clamped()) {
    if (!scene.sliding) fixed[i] = 0;
  }
  if (scene.sliding)
    for (int i = 0; i < space.x.size(); ++i)
      if (space.x.points()(i, 0) == 0) fixed[i] = 0;
  for (const int i : space.y.clamped()) fixed[shift + i] = -scene.push;
  problem.fixed_values.resize(static_cast<Eigen::Index>(fixed.size()));
  for (const auto& [i, value] : fixed) {
    problem.fixed_values(static_cast<Eigen::Index>(problem.fixed.size())) = value;
    problem.fixed.push_back(i);
  }
  problem.lower.resize(static_cast<Eigen::Index>(space.y.contact().size()));
  for (const int i : space.y.contact()) {
    problem.lower(static_cast<Eigen::Index>(problem.contact.size())) = -scene.gap(space.y.points()(i, 0));
    problem.contact.push_back(shift + i);
  }
  return problem;
}

TriangleMesh with_free_sides(TriangleMesh mesh) {
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const double x0 = mesh.vertices(mesh.edges(e, 0), 0), x1 = mesh.vertices(mesh.edges(e, 1), 0);
    if (mesh.edge_triangles(e, 1) < 0 && x0 == x1 && (x0 == 0 || x0 == 1)) mesh.edge_tag[e] = EdgeTag::free;
  }
  return mesh;
}

}  // namespace antilock
