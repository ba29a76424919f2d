#include "antilock/analysis/detail/certified_distance.hpp"

#include <fmt/format.h>

#include <cmath>

#include "antilock/core/error.hpp"

namespace antilock {

double certified_distance(const Certificate& certificate, const Companion& v, const Space& space,
                          const VariationalInequality& problem, const Solution& w) {
  const TriangleMesh& mesh = space.mesh();
  if (v.layer)
    throw Error(
        "certificate: the companion has columns of its own; accepted: one on the mesh, as strip_companion with "
        "on_mesh, "
        "p1_companion or an extruded mesh make it");
  const Eigen::Index per_triangle = v.stress.size() > 0 ? problem.b.rows() / v.stress.size() : 0;
  if (v.at_vertices.size() != mesh.vertex_count() || w.u.size() != space.size() || problem.size() != space.size() ||
      w.p.size() != problem.b.rows() || per_triangle * v.stress.size() != problem.b.rows())
    throw Error(fmt::format(
        "certificate: the companion has {} values and {} stresses, the solution {} and {}; accepted: both on one mesh",
        v.at_vertices.size(), v.stress.size(), w.u.size(), w.p.size()));

  const Eigen::MatrixX3d nodes = space.element().nodes();
  Eigen::VectorXd u = w.u, p = w.p;  // w - v
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Vector3d corners = v.at_vertices(mesh.triangles.row(t));
    for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
      const int unknown = space.unknowns()(t, i);
      u(unknown) = w.u(unknown) - nodes.row(i).dot(corners);
    }
  }
  for (Eigen::Index row = 0; row < p.size(); ++row) p(row) -= v.stress(row / per_triangle);
  const double stiff = problem.compliance * p.cwiseAbs2().dot(problem.m);
  return certificate.displacement + std::sqrt(u.dot(problem.a1 * u) + stiff);
}

}  // namespace antilock
