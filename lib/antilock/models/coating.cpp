#include "antilock/models/coating.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "antilock/core/error.hpp"
#include "antilock/models/detail/stiffness_range.hpp"

namespace antilock {

VariationalInequality assemble(const Coating& coating, const VectorSpace& space) {
  require_triangles(space.x.mesh(), "coating");
  const double t = coating.thickness;
  if (!(t >= 0 && t <= 1)) throw Error(fmt::format("coating: thickness {}; accepted 0 to 1", t));
  for (const Lame& material : {coating.body, coating.layer})
    if (!(material.mu > 0 && material.lambda >= 0))
      throw Error(fmt::format("coating: lambda = {}, mu = {}; accepted lambda >= 0 and mu > 0",
                              material.lambda, material.mu));
  for (const Space* part : {&space.x, &space.y})
    if (part->element().equation().size() > 0)
      throw Error("coating: element " + part->element().name() +
                  " is not accepted; P1 to P4, or CR, or P1 with CR");
  const auto& [lambda, mu] = coating.layer;
  Eigen::Matrix4d body = coating.body.matrix(), membrane = Eigen::Matrix4d::Zero();
  membrane(0, 0) = coating.layer.plane_strain_modulus();
  StiffnessRange range(mu);
  for (const double stiffness :
       {coating.body.mu, coating.body.lambda + 2 * coating.body.mu, membrane(0, 0)})
    range.note(stiffness);
  if (!space.x.element().conforming() || !space.y.element().conforming())
    range.note(2 * coating.jump_weight);
  range.check("coating");
  const bool body_fits_in_a1 = range.fits_in_a1(body.maxCoeff()),
             membrane_fits_in_a1 = range.fits_in_a1(membrane(0, 0));
  if (!body_fits_in_a1) body.setZero();
  if (!membrane_fits_in_a1) membrane.setZero();
  VariationalInequality problem;
  problem.a1 = strain_form(space, body, membrane);
  FactoredForm rows = strain_form_factored(
      space,
      {{{lambda / (lambda + 2 * mu) * t, 0, 0, 1}, lambda + 2 * mu},  // v_Y + r t u_x
       {{0, 1, t, 0}, mu}},                                           // u_Y + t v_x
      Region::layer);
  if (rows.m.size() == 0)
    throw Error("coating: the mesh has no layer; accepted: a body with a layer below");
  problem.b.swap(rows.b);
  problem.m = std::move(rows.m);
  problem.compliance = t * t;
  const auto append = [&](const std::vector<StrainTerm>& strains, Region region) {
    range.append(problem, stiff_strain_rows(space, strains, region));
  };
  if (!membrane_fits_in_a1)
    append({{{1, 0, 0, 0}, coating.layer.plane_strain_modulus()}}, Region::layer);
  if (!body_fits_in_a1) append(coating.body.rows(), Region::body);
  add_block_loading(problem, coating, space, &range);
  return problem;
}

Eigen::VectorXd pressure(const Coating& coating, const VectorSpace& space, const Eigen::VectorXd& u,
                         const Eigen::VectorXd& p) {
  require_triangles(space.x.mesh(), "coating");
  const TriangleMesh& mesh = space.x.mesh();
  const auto& [lambda, mu] = coating.body;
  const FactoredForm body =
      strain_form_factored(space, {{{lambda, 0, 0, lambda + 2 * mu}}}, Region::body);
  const Eigen::VectorXd stress = body.b * u;
  Eigen::VectorXd pressure = Eigen::VectorXd::Zero(mesh.triangle_count());
  const Eigen::VectorXd weights = strain_quadrature(space).weights;
  const Eigen::Index points = weights.size();
  for (Eigen::Index row = 0; row < stress.size(); ++row)
    pressure(body.cell[row]) -= weights(row % points) * stress(row);
  Eigen::Index row = 0;  // of each point of the coating the first of two
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (mesh.region[t] == Region::layer)
      for (Eigen::Index q = 0; q < points; ++q) {
        pressure(t) -= (coating.layer.lambda + 2 * coating.layer.mu) * weights(q) * p(row);
        row += 2;
      }
  return pressure;
}

std::optional<double> penalty(const Coating& coating, const VectorSpace& space) {
  if (coating.thickness == 0 || !(space.x.element().conforming() || space.y.element().conforming()))
    return {};
  return std::max(coating.thickness * coating.thickness, 1e-12);
}

}  // namespace antilock
