#include "antilock/analysis/locking_beside_cr.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/measure/errors.hpp"

namespace antilock {

VariationalInequality with_layer_at_rest(VariationalInequality problem, const Space& space,
                                         double height) {
  std::map<int, double> values;
  for (int t = 0; t < space.mesh().triangle_count(); ++t)
    if (space.mesh().region[t] == Region::layer)
      for (const int unknown : space.cell_dofs().row(t)) values[unknown] = height;
  for (std::size_t k = 0; k < problem.dirichlet_dofs.size(); ++k)
    values[problem.dirichlet_dofs[k]] = problem.dirichlet_values(static_cast<Eigen::Index>(k));
  if (!problem.bounds.unknowns.empty()) {
    const Eigen::VectorXd at_rest = Eigen::VectorXd::Constant(space.size(), height);
    if (distance_to_bound(problem.bounds, at_rest).minCoeff() < 0)
      throw Error("the layer at rest is beyond an obstacle");
    problem.bounds = {};
  }
  set_dirichlet(problem, values);
  return problem;
}

LockingReport locking_beside_cr(
    const Result& result, const std::function<VariationalInequality(const Space&)>& assemble_on,
    const std::function<Solution(const VariationalInequality&)>& solver, std::string diagnosis) {
  const Space& space = result.space;
  const auto energy_at_rest = [&](const VariationalInequality& problem, const Space& on) {
    const VariationalInequality at_rest = with_layer_at_rest(problem, on);
    return energy(at_rest, solver(at_rest));
  };
  LockingReport report;
  report.diagnosis = std::move(diagnosis);
  double kept = 0;
  try {
    const Space cr(space, crouzeix_raviart(space.mesh().kind));
    const VariationalInequality of_cr = assemble_on(cr);
    report.reference = energy_at_rest(of_cr, cr) - energy(of_cr, solver(of_cr));
    kept = energy_at_rest(result.problem, space) - energy(result.problem, result.solution);
  } catch (const Error& error) {  // the solution is valid without this report
    report.diagnosis += std::string("; nothing is known of what it costs (") + error.what() + ")";
    return report;
  }
  report.estimate = report.reference > 0 ? std::clamp(1 - kept / report.reference, 0.0, 1.0) : 0;
  report.diagnosis += fmt::format(
      "; beside CR on this mesh it loses about {:.0f} % of the energy that the layer's motion "
      "releases",
      100 * report.estimate);
  if (report.estimate >= comparison_significance)
    report.warning = fmt::format(
        "{} locks in this layer: it loses about {:.0f} % of the energy that the layer's motion "
        "releases (by a second solve, with CR); remedy: element = \"CR\", or a layer in columns",
        space.element().name(), std::floor(100 * report.estimate));
  return report;
}

}  // namespace antilock
