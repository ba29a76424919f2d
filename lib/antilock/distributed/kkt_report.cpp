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

/// The parts of the report, summed over the ranks, per owned row.
KktParts summed_parts(const DistributedProblem& problem, const State& state) {
  KktParts parts = kkt_parts(problem.part(), state.u, state.p);
  for (Eigen::VectorXd* part : {&parts.r1, &parts.terms, &parts.stiffness})
    *part = summed(problem.rows(), *part);
  return parts;
}

/// Per owned row: whether its value is prescribed.
std::vector<char> clamped_rows(const DofMap& rows) {
  std::vector<char> clamped;
  for (int i = 0; i < rows.owned(); ++i) clamped.push_back(rows.clamped(rows.unknown(i)) ? 1 : 0);
  return clamped;
}

/// Adds gap, pressure and complementarity of all bounds, over all ranks. `reach` and `forces` are
/// those of add_bound.
void add_bounds(Kkt& kkt, const DistributedProblem& problem, const Eigen::VectorXd& u,
                const Eigen::VectorXd& lambda, double reach, const Eigen::VectorXd& forces) {
  const DofMap& rows = problem.rows();
  const BoundLimits bounds(problem.lower());
  kkt.min_gap = std::numeric_limits<double>::infinity();
  kkt.min_pressure = std::numeric_limits<double>::infinity();
  for (int i = 0; i < rows.owned(); ++i)
    if (std::isfinite(problem.lower()(i)))
      add_bound(kkt, bounds, i, u(rows.unknown(i)), lambda(i), reach, forces(i));
  kkt.complementarity = largest(kkt.complementarity);
  kkt.min_gap = -largest(-kkt.min_gap);
  kkt.min_pressure = -largest(-kkt.min_pressure);
  if (!std::isinf(kkt.min_gap)) return;
  kkt.min_gap = 0;  // nothing is bounded
  kkt.min_pressure = 0;
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
  const Eigen::VectorXd& u = state.u;
  Kkt kkt;
  const bool broken = !u.allFinite() || !state.p.allFinite();
  if (largest(broken ? 1 : 0) > 0) {  // a maximum may pass over what is not a number
    kkt.residual = std::numeric_limits<double>::infinity();
    return kkt;
  }
  KktParts parts = summed_parts(problem, state);
  const Eigen::VectorXd lambda = contact_forces(problem, state);
  const Eigen::VectorXd load = summed(rows, problem.part().load);
  const std::vector<char> clamped = clamped_rows(rows);
  double force = 0;
  double reaction = 0;
  for (int i = 0; i < rows.owned(); ++i) {
    parts.add_force(i, lambda(i));
    force = std::max({force, std::abs(load(i)), std::abs(lambda(i))});
    if (clamped[i] != 0) reaction = std::max(reaction, std::abs(parts.r1(i)));
  }
  force = largest(force);
  reaction = largest(reaction);
  const double largest_u = largest(u.size() > 0 ? u.lpNorm<Eigen::Infinity>() : 0);
  const Eigen::VectorXd forces =
      add_equations(kkt, parts, clamped, largest_u, force, std::max(force, reaction));
  kkt.residual = largest(kkt.residual);
  add_bounds(kkt, problem, u, lambda, largest_u, forces);
  return kkt;
}

Kkt certified(const DistributedProblem& problem, const State& state, double tolerance,
              std::string& warning) {
  Solution result;
  result.solver = "petsc";
  result.kkt = kkt_report(problem, state);
  apply_tolerances(result, KktTolerances{.fail = CorrectionOptions{tolerance}.kkt_fail()});
  warning = result.warning;
  return result.kkt;
}

}  // namespace antilock::distributed
