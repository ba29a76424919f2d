#include "common/crouzeix_raviart.hpp"

#include "antilock/io/writers.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/study/method.hpp"

namespace antilock::tutorial {

void draw_basis_function(const std::filesystem::path& path) {
  const Discretisation on(unstructured_mesh(3), crouzeix_raviart());
  Eigen::Index edge = 0;
  (on.space().points().rowwise() - Eigen::RowVector2d(0.5, -0.5)).rowwise().squaredNorm().minCoeff(&edge);
  write_vtu(path, on.space(), Eigen::VectorXd::Unit(on.space().size(), edge));
}

double largest_jump(const Space& space, const Eigen::VectorXd& u) {
  const TriangleMesh& mesh = space.mesh();
  const auto value_at = [&](int t, int vertex) {
    int corner = 0;
    while (mesh.triangles(t, corner) != vertex) ++corner;
    return space.element().basis(Eigen::Vector3d::Unit(corner)).dot(Eigen::VectorXd(u(space.unknowns().row(t))));
  };
  double jump = 0;
  for (int e = 0; e < mesh.edge_count(); ++e) {
    const int a = mesh.edge_triangles(e, 0), b = mesh.edge_triangles(e, 1);
    for (int end = 0; end < 2 && b >= 0; ++end)
      jump = std::max(jump, std::abs(value_at(a, mesh.edges(e, end)) - value_at(b, mesh.edges(e, end))));
  }
  return jump;
}

}  // namespace antilock::tutorial
