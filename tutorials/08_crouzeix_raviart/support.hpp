#pragma once
#include <algorithm>
#include <filesystem>

#include "antilock/io/write_vtu.hpp"
#include "antilock/study/method.hpp"

namespace antilock::tutorial {

/// One basis function of P1 on the six triangles of its vertex (hat.vtu), and one of
/// Crouzeix-Raviart on the two of its edge (basis.vtu).
inline void draw_basis_functions(const std::filesystem::path& out) {
  TriangleMesh fan;
  fan.vertices.resize(7, 2);
  fan.vertices << 0, 0, 0.25, -1, 0.75, -1, 1, 0, 0.75, 1, 0.25, 1, 0.5, 0;
  fan.triangles.resize(6, 3);
  for (int t = 0; t < 6; ++t) fan.triangles.row(t) << t, (t + 1) % 6, 6;
  fan.region.assign(6, Region::body);
  write_vtu(out / "hat.vtu", fan, Eigen::RowVector3d(0, 0, 1).replicate(6, 1));
  TriangleMesh pair;
  pair.vertices.resize(4, 2);
  pair.vertices << 0, 0, 1, 0, 0.5, 1, 0.5, -1;
  pair.triangles.resize(2, 3);
  pair.triangles << 0, 1, 2, 1, 0, 3;
  pair.region.assign(2, Region::body);
  write_vtu(out / "basis.vtu", pair, Eigen::RowVector3d(1, 1, -1).replicate(2, 1));
}

/// The largest step of a function of Crouzeix-Raviart between two triangles, at the ends of
/// their common edge (at its midpoint they meet).
inline double largest_jump(const Space& space, const Eigen::VectorXd& u) {
  const TriangleMesh& mesh = space.mesh();
  const auto value_at = [&](int t, int vertex) {
    int corner = 0;
    while (mesh.triangles(t, corner) != vertex) ++corner;
    return space.element()
        .basis(Eigen::Vector3d::Unit(corner))
        .dot(Eigen::VectorXd(u(space.cell_dofs().row(t))));
  };
  double jump = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = mesh.edge_triangles(e, 0), b = mesh.edge_triangles(e, 1);
    for (int end = 0; end < 2 && b >= 0; ++end)
      jump = std::max(jump, std::abs(value_at(a, mesh.edges(e, end)) -
                                     value_at(b, mesh.edges(e, end))));
  }
  return jump;
}

}  // namespace antilock::tutorial
