#include "antilock/models/plate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "antilock/core/error.hpp"
#include "antilock/form/gradient_forms.hpp"
#include "antilock/problem/variational_inequality.hpp"

namespace antilock {
namespace {

/// The unknowns on the rim, and their values.
std::map<int, double> held(const Plate& plate, const PlateSpace& space) {
  const TriangleMesh& mesh = space.mesh();
  std::map<int, double> values;
  const auto hold = [&](const Space& part, int first, const Field& value) {
    for (const int i : part.dirichlet_dofs())
      values[first + i] = value(part.dof_coordinates()(i, 0), part.dof_coordinates()(i, 1));
  };
  hold(space.deflection, 0, plate.boundary_deflection);
  hold(space.rotation.x, space.theta_x(), plate.boundary_rotation_x);
  hold(space.rotation.y, space.theta_y(), plate.boundary_rotation_y);
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (!is_dirichlet(mesh.edge_tag[e])) continue;
    const Eigen::RowVector2d a = mesh.vertices.row(mesh.edges(e, 0)),
                             b = mesh.vertices.row(mesh.edges(e, 1));
    const Eigen::RowVector2d middle = (a + b) / 2, along = (b - a).normalized();
    const auto curve = [&](const Field& f) {  // Simpson's mean minus the mean of the ends
      return 2 * (f(middle(0), middle(1)) - (f(a(0), a(1)) + f(b(0), b(1))) / 2) / 3;
    };
    if (!space.deflection.element().conforming())
      values[e] =
          (plate.boundary_deflection(a(0), a(1)) + plate.boundary_deflection(b(0), b(1))) / 2 +
          curve(plate.boundary_deflection);
    if (space.shear == ShearRule::edges)
      values[space.on_edges() + e] =
          along(0) * curve(plate.boundary_rotation_x) + along(1) * curve(plate.boundary_rotation_y);
  }
  return values;
}

/// The corners of the rim lie on the obstacle or above; else no plate at all lies above the
/// obstacle, and only the mesh hides it. They are where they are to 1e-9 of an edge or so: a
/// millionth of what the gap is around them counts as 0.
void require_rim_above(const Plate& plate, const TriangleMesh& mesh) {
  const auto gap = [&](int corner) {
    return plate.gap(mesh.vertices(corner, 0), mesh.vertices(corner, 1));
  };
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (!is_dirichlet(mesh.edge_tag[e])) continue;
    double around = 0;
    for (const int corner : mesh.triangles.row(mesh.edge_triangles(e, 0)))
      if (const double size = std::abs(gap(corner)); std::isfinite(size))
        around = std::max(around, size);
    for (const int corner : mesh.edges.row(e)) {
      const double x = mesh.vertices(corner, 0);
      const double y = mesh.vertices(corner, 1);
      const double rim = plate.boundary_deflection(x, y);
      if (rim + gap(corner) < -1e-6 * around)
        throw Error(fmt::format(
            "plate: the rim is held at w = {:.6g} in ({:.6g}, {:.6g}), below the obstacle at "
            "{:.6g}; accepted: on it or above",
            rim, x, y, -gap(corner)));
    }
  }
}

}  // namespace

VariationalInequality assemble(const Plate& plate, const PlateSpace& space) {
  require_triangles(space.mesh(), "plate");
  if (!(plate.thickness >= 0 && plate.thickness <= 1))
    throw Error(fmt::format("plate: thickness = {}; accepted 0 to 1", plate.thickness));
  if (!(plate.poisson >= 0 && plate.poisson < 1))
    throw Error(
        fmt::format("plate: Poisson's ratio = {}; accepted 0 to less than 1", plate.poisson));
  for (const Field* field : {&plate.load, &plate.gap, &plate.boundary_deflection,
                             &plate.boundary_rotation_x, &plate.boundary_rotation_y})
    if (!*field)
      throw Error(
          "plate: a function is empty; accepted: load, gap and the values on the rim, or their "
          "defaults");
  VariationalInequality problem;
  problem.a1 = bending_form(space, plate.poisson);
  FactoredForm shear = shear_form(space);
  problem.b.swap(shear.b);
  problem.m.swap(shear.m);
  problem.compliance = plate.thickness * plate.thickness;  // the class parameter is t^2
  problem.load = Eigen::VectorXd::Zero(space.size());
  problem.load.head(space.deflection.size()) = load_vector(space.deflection, plate.load);

  const std::map<int, double> fixed = held(plate, space);
  set_dirichlet(problem, fixed);
  std::vector<int> bounded;
  std::vector<double> lower;
  for (int i = 0; i < space.deflection.size(); ++i) {
    const double gap = plate.gap(space.deflection.dof_coordinates()(i, 0),
                                 space.deflection.dof_coordinates()(i, 1));
    if (std::isnan(gap) || gap == -std::numeric_limits<double>::infinity())
      throw Error(fmt::format(
          "plate: the gap is {}; accepted: a number, or infinity for no obstacle", gap));
    if (fixed.count(i) > 0 || std::isinf(gap)) continue;
    bounded.push_back(i);
    lower.push_back(-gap);
  }
  require_rim_above(plate, space.mesh());
  problem.bounds = Bounds::lower_on(
      bounded,
      Eigen::Map<const Eigen::VectorXd>(lower.data(), static_cast<Eigen::Index>(lower.size())));
  return problem;
}

}  // namespace antilock
