#include "antilock/measure/contact_zone.hpp"

#include <algorithm>

namespace antilock {

ContactZone contact_zone(const Space& space, const VariationalInequality& problem, const Solution& solution) {
  ContactZone zone;
  zone.points = static_cast<int>(problem.contact.size());
  for (int i = 0; i < zone.points; ++i) {
    if (!solution.active[i]) continue;
    const double x = space.points()(problem.contact[i], 0);
    ++zone.active;
    zone.from = std::min(zone.from.value_or(x), x);
    zone.to = std::max(zone.to.value_or(x), x);
  }
  return zone;
}

Eigen::VectorXd contact_lengths(const Space& space) {
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  // int phi_i over the edge: shared by its unknowns as the element's basis says (midpoint: 1; ends: 1/2 each)
  Eigen::VectorXd length = Eigen::VectorXd::Zero(space.size());
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    const int t = mesh.edge_triangles(e, 0);
    for (int i = 0; i < 3; ++i) {
      if (mesh.triangle_edges(t, i) != e) continue;
      Eigen::Vector3d a = Eigen::Vector3d::Zero(), b = a;
      a((i + 1) % 3) = b((i + 2) % 3) = 1;
      // Boole's rule: exact up to degree 5
      const Eigen::VectorXd integral =
          (7 * (element.basis(a) + element.basis(b)) + 12 * element.basis(0.5 * (a + b)) +
           32 * (element.basis(0.75 * a + 0.25 * b) + element.basis(0.25 * a + 0.75 * b))) /
          90;
      for (Eigen::Index k = 0; k < integral.size(); ++k)
        length(space.unknowns()(t, k)) += mesh.edge_length(e) * integral(k);
    }
  }
  return length(space.contact());
}

Eigen::MatrixX3d contact_table(const Space& space, const VariationalInequality& problem, const Solution& solution) {
  const auto count = static_cast<Eigen::Index>(problem.contact.size());
  Eigen::MatrixX3d table(count, 3);
  table.col(0) = space.points().col(0)(problem.contact);
  table.col(1) = solution.u(problem.contact) - problem.lower;
  table.col(2) = solution.lambda.cwiseQuotient(contact_lengths(space));
  return table;
}

}  // namespace antilock
