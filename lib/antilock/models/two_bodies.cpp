#include "antilock/models/two_bodies.hpp"

#include <fmt/format.h>

#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/models/anti_plane.hpp"

namespace antilock {
namespace {

/// The mean gap of each constraint.
Eigen::VectorXd mean_gap(const InterfaceConstraints& constraints, const Field& gap) {
  Eigen::VectorXd at_points(constraints.points.rows());
  for (Eigen::Index q = 0; q < at_points.size(); ++q) {
    const double x = constraints.points(q, 0), y = constraints.points(q, 1);
    at_points(q) = gap(x, y);
    if (!std::isfinite(at_points(q)))
      throw Error(fmt::format("two bodies: gap({:.6g}, {:.6g}) is not finite", x, y));
  }
  return constraints.means * at_points;
}

/// Bounds of rows * u from below.
Bounds bounds_of(RowMatrix rows, const InterfaceConstraints& constraints, const Field& gap) {
  rows.makeCompressed();
  return {{}, BoundLimits(-mean_gap(constraints, gap)), rows};
}

}  // namespace

VariationalInequality assemble(const Scene& scene, const TwoBodyContact& contact,
                               const Space& space) {
  if (scene.contact())
    throw Error("two bodies: the scene has a rigid obstacle, too; accepted: one of the two");
  const InterfaceConstraints constraints =
      interface_constraints(space, contact.slave, contact.master, contact.method);
  if (std::abs(constraints.normal(1)) < 1e-6)
    throw Error(
        "two bodies: the interface is vertical, so that no body is above the other; accepted: "
        "another direction");
  const double sign = constraints.normal(1) < 0 ? 1 : -1;  // of the slave, if it is above
  VariationalInequality problem = assemble(scene, space);
  problem.bounds = bounds_of(sign * constraints.jump, constraints, contact.gap);
  return problem;
}

void set_normal_contact(VariationalInequality& problem, const TwoBodyContact& contact,
                        const VectorSpace& space) {
  if (&space.x.element() != &space.y.element() || !have_one_mesh(space.x, space.y))
    throw Error("two bodies: the components have two spaces; accepted: one space for both");
  const InterfaceConstraints constraints =
      interface_constraints(space.x, contact.slave, contact.master, contact.method);
  problem.bounds =
      bounds_of(component_jump(constraints.jump, -constraints.normal), constraints, contact.gap);
}

Eigen::MatrixX3d interface_table(const InterfaceConstraints& constraints, const Bounds& bounds,
                                 const Eigen::VectorXd& u, const Eigen::VectorXd& lambda) {
  Eigen::MatrixX3d table(constraints.places.rows(), 3);
  table.col(0) = constraints.places.col(0);
  table.col(1) = distance_to_bound(bounds, u);
  table.col(2) = lambda.cwiseQuotient(constraints.lengths);
  return table;
}

}  // namespace antilock
