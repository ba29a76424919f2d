#include "antilock/measure/contact_zone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>

#include "antilock/core/error.hpp"
#include "antilock/measure/contact_edges.hpp"
#include "antilock/mesh/quadrature.hpp"
#include "antilock/problem/bounds.hpp"

namespace antilock {

namespace {

/// Throws Error unless the space has one unknown on Gamma_C per bound.
void require_space_of_bounds(const Result& result, const std::string& who) {
  const Space& space = result.space;
  const VariationalInequality& problem = result.problem;
  require_bounds_on_unknowns(problem.bounds, who);
  require_hard_bounds(problem.bounds, who);
  if (space.contact_dofs().size() != problem.bounds.unknowns.size())
    throw Error(
        fmt::format("{}: {} bounds and a space with {} unknowns on Gamma_C; accepted: that of the "
                    "component with bounds",
                    who, problem.bounds.unknowns.size(), space.contact_dofs().size()));
}

}  // namespace

ContactZone contact_zone(const Result& result) {
  if (result.problem.bounds.count() == 0) return {};
  require_space_of_bounds(result, "contact zone");
  const Space& space = result.space;
  const Eigen::VectorXd x = space.dof_coordinates().col(0)(space.contact_dofs());
  const std::vector<bool>& active = result.solution.active;
  ContactZone zone = contact_zone(x, active, contact_ends(space.mesh()));
  if (space.mesh().dimension() == 2) return zone;
  zone.from_within.reset();
  zone.to_within.reset();
  const Eigen::VectorXd y = space.dof_coordinates().col(1)(space.contact_dofs());
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    if (!active[static_cast<std::size_t>(i)]) continue;
    const auto [least, most] = zone.y_range.value_or(std::pair(y(i), y(i)));
    zone.y_range = std::pair(std::min(least, y(i)), std::max(most, y(i)));
  }
  return zone;
}

ContactZone contact_zone(const Eigen::VectorXd& x, const std::vector<bool>& active,
                         const std::pair<double, double>& ends) {
  ContactZone zone;
  zone.points = static_cast<int>(x.size());
  for (int i = 0; i < zone.points; ++i) {
    if (!active[i]) continue;
    ++zone.active;
    if (!zone.from) {
      zone.from = x(i);
      zone.from_within = std::pair(i > 0 ? x(i - 1) : ends.first, x(i));
    }
    zone.to = x(i);
    zone.to_within = std::pair(x(i), i + 1 < zone.points ? x(i + 1) : ends.second);
  }
  return zone;
}

std::pair<double, double> contact_ends(const TriangleMesh& mesh, EdgeTag tag) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::pair<double, double> ends{infinity, -infinity};
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != tag) continue;
    for (const int v : mesh.edges.row(e)) {
      ends.first = std::min(ends.first, mesh.vertices(v, 0));
      ends.second = std::max(ends.second, mesh.vertices(v, 0));
    }
  }
  return ends;
}

ContactForce contact_force(const Result& result) {
  if (result.problem.bounds.count() == 0) return {};
  require_space_of_bounds(result, "contact force");
  const Space& space = result.space;
  const Eigen::VectorXd x = space.dof_coordinates().col(0)(space.contact_dofs());
  ContactForce force;
  force.normal = result.solution.lambda.sum();
  force.moment = result.solution.lambda.dot(x);
  if (space.mesh().dimension() == 2) return force;
  const Eigen::VectorXd y = space.dof_coordinates().col(1)(space.contact_dofs());
  force.moment_y = result.solution.lambda.dot(y);
  return force;
}

Eigen::VectorXd contact_lengths(const Space& space) {
  const TriangleMesh& mesh = space.mesh();
  const Element& element = space.element();
  if (mesh.dimension() == 3 && element.degree() > 1)
    throw Error("contact lengths: the element " + element.name() +
                " on faces; accepted: P1 and CR");
  // int phi_i over the facet: shared by its unknowns as the element's basis says (midpoint: 1;
  // ends: 1/2 each)
  Eigen::VectorXd length = Eigen::VectorXd::Zero(space.size());
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::contact) continue;
    const int t = mesh.edge_triangles(e, 0);
    length(space.cell_dofs().row(t)) +=
        mesh.facet_measure(e) * means_on_facet(element, local_edge(mesh, t, e));
  }
  return length(space.contact_dofs());
}

Eigen::MatrixXd contact_table(const Result& result) {
  require_space_of_bounds(result, "contact table");
  const Space& space = result.space;
  const std::vector<int>& places = space.contact_dofs();
  const auto count = static_cast<Eigen::Index>(places.size());
  const int along = space.mesh().vertical();  // 1 or 2 coordinates
  Eigen::MatrixXd table(count, along + 2);
  for (int k = 0; k < along; ++k) table.col(k) = space.dof_coordinates().col(k)(places);
  table.col(along) = distance_to_bound(result.problem.bounds, result.solution.u);
  table.col(along + 1) = result.solution.lambda.cwiseQuotient(contact_lengths(space));
  return table;
}

}  // namespace antilock
