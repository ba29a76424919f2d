#include "antilock/distributed/kkt_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "antilock/core/error.hpp"
#include "antilock/distributed/ranks.hpp"
#include "antilock/solve/kkt.hpp"

namespace antilock::distributed {
namespace {

double ratio(double value, double scale) { return value == 0 ? 0.0 : value / scale; }

/// Per owned row: the sum over the ranks of what each has at its unknowns.
Eigen::VectorXd summed(const Rows& rows, const Eigen::VectorXd& part) {
  const Vector v = rows.vector();
  rows.summed(part, v);
  const PetscScalar* values = nullptr;
  ok(VecGetArrayRead(v, &values));
  Eigen::VectorXd sums = Eigen::Map<const Eigen::VectorXd>(values, rows.owned());
  ok(VecRestoreArrayRead(v, &values));
  return sums;
}

double size(const Eigen::VectorXd& v) { return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0; }

}  // namespace

Eigen::VectorXd contact_forces(const Inequality& problem, const State& state) {
  Eigen::VectorXd lambda = -summed(problem.rows(), problem.equilibrium(state.u, state.p));
  for (Eigen::Index i = 0; i < lambda.size(); ++i)
    if (state.active[i] == 0) lambda(i) = 0;
  return lambda;
}

Kkt kkt_report(const Inequality& problem, const State& state) {
  const VariationalInequality& part = problem.part();
  const Rows& rows = problem.rows();
  const Eigen::VectorXd &u = state.u, &p = state.p, &lower = problem.lower();
  Kkt kkt;
  const bool broken = !u.allFinite() || !p.allFinite();
  if (largest(broken ? 1 : 0) > 0) {  // a maximum may pass over what is not a number
    kkt.residual = std::numeric_limits<double>::infinity();
    return kkt;
  }
  const Eigen::VectorXd r1_part = problem.equilibrium(u, p), r1 = summed(rows, r1_part);
  const Eigen::VectorXd load = summed(rows, part.load), diagonal = summed(rows, part.a1.diagonal());
  Eigen::VectorXd terms_part = part.a1.cwiseAbs() * u.cwiseAbs() + part.load.cwiseAbs(), own_part = part.a1.diagonal();
  if (part.m.size() > 0) {
    terms_part += part.b.cwiseAbs().transpose() * part.m.cwiseProduct(p.cwiseAbs());
    own_part += part.b.cwiseAbs2().transpose() * part.m;
  }
  double single = 0;
  for (Eigen::Index i = 0; i < load.size(); ++i)
    if (diagonal(i) > 0) single = std::max(single, std::abs(load(i)) / diagonal(i));
  const Eigen::VectorXd lambda = contact_forces(problem, state);
  const double f_scale = largest(std::max(size(load), size(lambda))), u_scale = largest(std::max(size(u), single));
  const double forces = std::max(f_scale, rows.largest_at_clamped(r1_part));
  const Eigen::VectorXd terms = summed(rows, terms_part);
  const Eigen::VectorXd own = terms.cwiseMax(u_scale * summed(rows, own_part)).cwiseMax(lambda.cwiseAbs());

  kkt.min_gap = kkt.min_pressure = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < r1.size(); ++i) {
    const double left = std::abs(r1(i) + lambda(i)) - 8 * std::numeric_limits<double>::epsilon() * terms(i);
    kkt.residual = std::max(kkt.residual, ratio(std::max(left, 0.0), std::min(own(i), forces)));
    if (std::isinf(lower(i))) continue;
    const double gap = u(rows.unknown(static_cast<int>(i))) - lower(i), scale = std::max(u_scale, std::abs(lower(i)));
    const double force = std::min(own(i), f_scale);
    kkt.min_gap = std::min(kkt.min_gap, ratio(gap, scale));
    kkt.min_pressure = std::min(kkt.min_pressure, ratio(lambda(i), force));
    kkt.complementarity = std::max(kkt.complementarity, ratio(std::abs(lambda(i) * gap), scale * force));
  }
  if (part.m.size() > 0) {
    const Eigen::VectorXd strain = problem.compatibility(u, p).cwiseQuotient(absolute_row_sums(part.b));
    kkt.residual = std::max(kkt.residual, ratio(size(strain), u_scale));
  }
  kkt.residual = largest(kkt.residual), kkt.complementarity = largest(kkt.complementarity);
  kkt.min_gap = -largest(-kkt.min_gap), kkt.min_pressure = -largest(-kkt.min_pressure);
  if (std::isinf(kkt.min_gap)) kkt.min_gap = kkt.min_pressure = 0;  // nothing is bounded
  return kkt;
}

Kkt certified(const Inequality& problem, const State& state, double tolerance, std::string& warning) {
  const Kkt kkt = kkt_report(problem, state);
  const double worst = worst_violation(kkt);
  TrustLevels levels;
  levels.refused = std::max(levels.refused, 10 * tolerance);
  const std::string report =
      fmt::format("smallest gap {:.1e}, smallest pressure {:.1e}, complementarity {:.1e}, residual {:.1e}", kkt.min_gap,
                  kkt.min_pressure, kkt.complementarity, kkt.residual);
  if (!(worst <= levels.refused))
    throw NotConverged(fmt::format("petsc: answer refused: the conditions hold only to {:.1e}, accepted {:.0e} ({})",
                                   worst, levels.refused, report),
                       worst, 0);
  warning.clear();
  if (worst > levels.trusted)
    warning = fmt::format("petsc: the conditions hold to {:.1e}, trusted {:.0e} ({})", worst, levels.trusted, report);
  return kkt;
}

}  // namespace antilock::distributed
