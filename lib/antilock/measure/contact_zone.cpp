#include "antilock/measure/contact_zone.hpp"

#include <fmt/format.h>

#include <algorithm>
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
  const std::vector<int>& places = result.space.contact_dofs();
  ContactZone zone;
  zone.points = static_cast<int>(result.problem.bounds.unknowns.size());
  for (int i = 0; i < zone.points; ++i) {
    if (!result.solution.active[i]) continue;
    const double x = result.space.dof_coordinates()(places[i], 0);
    ++zone.active;
    zone.from = std::min(zone.from.value_or(x), x);
    zone.to = std::max(zone.to.value_or(x), x);
  }
  return zone;
}

Eigen::VectorXd contact_lengths(const Space& space) {
  // int phi_i over the edge: shared by its unknowns as the element's basis says (midpoint: 1; ends:
  // 1/2 each)
  Eigen::VectorXd length = Eigen::VectorXd::Zero(space.size());
  for (const ContactEdge& edge : contact_edges(space.mesh()))
    length(space.cell_dofs().row(edge.triangle)) +=
        edge.length * means_on_edge(space.element(), edge.opposite);
  return length(space.contact_dofs());
}

Eigen::MatrixX3d contact_table(const Result& result) {
  require_space_of_bounds(result, "contact table");
  const Space& space = result.space;
  const std::vector<int>& places = space.contact_dofs();
  const auto count = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixX3d table(count, 3);
  table.col(0) = space.dof_coordinates().col(0)(places);
  table.col(1) = distance_to_bound(result.problem.bounds, result.solution.u);
  table.col(2) = result.solution.lambda.cwiseQuotient(contact_lengths(space));
  return table;
}

}  // namespace antilock
