#include "antilock/distributed/kkt_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/distributed/ranks.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/kkt.hpp"

namespace antilock::distributed {
namespace {

/// Per owned row: the sum over the ranks of what each has at its unknowns.
Eigen::VectorXd summed(const DofMap& rows, const Eigen::VectorXd& part) {
  const Vector v = rows.vector();
  rows.summed(part, v);
  return Entries(v);
}

}  // namespace

Eigen::VectorXd contact_forces(const DistributedProblem& problem, const State& state) {
  Eigen::VectorXd lambda = -summed(problem.rows(), problem.equilibrium(state.u, state.p));
  for (Eigen::Index i = 0; i < lambda.size(); ++i)
    if (state.active[i] == 0) lambda(i) = 0;
  return lambda;
}

Kkt kkt_report(const DistributedProblem& problem, const State& state) {
  const DofMap& rows = problem.rows();
  const Eigen::VectorXd &u = state.u, &p = state.p, &lower = problem.lower();
  Kkt kkt;
  const bool broken = !u.allFinite() || !p.allFinite();
  if (largest(broken ? 1 : 0) > 0) {  // a maximum may pass over what is not a number
    kkt.residual = std::numeric_limits<double>::infinity();
    return kkt;
  }
  KktParts parts = kkt_parts(problem.part(), u, p);
  for (Eigen::VectorXd* part : {&parts.r1, &parts.terms, &parts.stiffness}) *part = summed(rows, *part);
  const Eigen::VectorXd lambda = contact_forces(problem, state), load = summed(rows, problem.part().load);
  double force = 0, reaction = 0;
  std::vector<char> clamped;
  for (int i = 0; i < rows.owned(); ++i) {
    parts.add_force(i, lambda(i));
    force = std::max({force, std::abs(load(i)), std::abs(lambda(i))});
    clamped.push_back(rows.clamped(rows.unknown(i)) ? 1 : 0);
    if (clamped.back() != 0) reaction = std::max(reaction, std::abs(parts.r1(i)));
  }
  force = largest(force);
  const double largest_u = largest(u.size() > 0 ? u.lpNorm<Eigen::Infinity>() : 0);
  const Eigen::VectorXd forces =
      add_equations(kkt, parts, clamped, largest_u, force, std::max(force, largest(reaction)));
  kkt.residual = largest(kkt.residual);
  kkt.min_gap = kkt.min_pressure = std::numeric_limits<double>::infinity();
  const Bounds bounds{lower};
  for (int i = 0; i < rows.owned(); ++i)
    if (std::isfinite(lower(i))) add_bound(kkt, bounds, i, u(rows.unknown(i)), lambda(i), largest_u, forces(i));
  kkt.complementarity = largest(kkt.complementarity);
  kkt.min_gap = -largest(-kkt.min_gap), kkt.min_pressure = -largest(-kkt.min_pressure);
  if (std::isinf(kkt.min_gap)) kkt.min_gap = kkt.min_pressure = 0;  // nothing is bounded
  return kkt;
}

Kkt certified(const DistributedProblem& problem, const State& state, double tolerance, std::string& warning) {
  Solution result;
  result.solver = "petsc";
  result.kkt = kkt_report(problem, state);
  apply_tolerances(result, KktTolerances{.fail = CorrectionOptions{tolerance}.kkt_fail()});
  warning = result.warning;
  return result.kkt;
}

}  // namespace antilock::distributed
