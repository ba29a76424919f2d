#include "antilock/solve/kkt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/core/error.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/defaults.hpp"

namespace antilock {
namespace {

// Why these scales. The terms of A1 u are larger than the forces at work by h^-2, h the mesh width,
// and would hide an error: so the scale of a row is at most F. A large force at one place must hide
// nothing at another, nor a far obstacle a near one: so each unknown and each bound has a scale of
// its own. Rounding u and p to doubles is no error: so 8 eps t is subtracted. A strain has the unit
// of its row. Prescribed values hold exactly. Between two bounds either sign of lambda is right,
// and each side counts alone. A bound that slips has no gap to keep, and beyond it lambda is the
// force limit.

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// 0 / 0 is a condition met exactly.
double ratio(double value, double scale) { return value == 0 ? 0.0 : value / scale; }

/// The smaller and the larger one; not a number where one of them is not.
double min_or_nan(double a, double b) { return std::isnan(a) || a < b ? a : b; }
double max_or_nan(double a, double b) { return std::isnan(a) || a > b ? a : b; }

void check_sizes(const VariationalInequality& problem, const Solution& solution) {
  const Eigen::Index u = solution.u.size();
  const Eigen::Index p = solution.p.size();
  const Eigen::Index lambda = solution.lambda.size();
  if (u == problem.size() && p == problem.b.rows() && lambda == problem.bounds.count()) return;
  throw Error(fmt::format("kkt: u, p and lambda have {}, {} and {} entries; accepted {}, {} and {}",
                          u, p, lambda, problem.size(), problem.b.rows(), problem.bounds.count()));
}

/// Calls of(unknown, coefficient) for the unknowns whose sum the bound i bounds.
template <class Function>
void for_each_unknown(const Bounds& bounds, int i, const Function& of) {
  const int on_unknowns = static_cast<int>(bounds.unknowns.size());
  if (i < on_unknowns) return of(bounds.unknowns[i], 1.0);
  for (RowMatrix::InnerIterator c(bounds.constraints, i - on_unknowns); c; ++c)
    if (c.value() != 0) of(static_cast<int>(c.col()), c.value());
}

/// Adds E' lambda to r1 and t. Returns F_0.
double add_bound_forces(KktParts& parts, const VariationalInequality& problem,
                        const Eigen::VectorXd& lambda) {
  double largest_force = problem.load.lpNorm<Eigen::Infinity>();
  for (int i = 0; i < problem.bounds.count(); ++i)
    for_each_unknown(problem.bounds, i, [&](int unknown, double c) {
      parts.add_force(unknown, c * lambda(i));
      largest_force = std::max(largest_force, std::abs(c * lambda(i)));
    });
  return largest_force;
}

/// Adds all bounds, each with its own scales. `forces` (N) is the result of add_equations.
void add_bounds(Kkt& kkt, const Bounds& bounds, const Solution& solution, double largest_u,
                const Eigen::VectorXd& forces) {
  const Eigen::VectorXd values = bounded_values(bounds, solution.u);
  kkt.min_gap = unbounded;
  kkt.min_pressure = unbounded;
  for (int i = 0; i < bounds.count(); ++i) {
    double sum_of_coefficients = 0;
    double force = unbounded;
    for_each_unknown(bounds, i, [&](int unknown, double c) {
      sum_of_coefficients += std::abs(c);
      force = std::min(force, forces(unknown) / std::abs(c));
    });
    add_bound(kkt, bounds, i, values(i), solution.lambda(i), largest_u * sum_of_coefficients,
              force);
  }
  if (kkt.min_gap == unbounded) kkt.min_gap = 0;  // every bound has a force limit
}

}  // namespace

KktParts kkt_parts(const VariationalInequality& problem, const Eigen::VectorXd& u,
                   const Eigen::VectorXd& p) {
  const Eigen::VectorXd stress = problem.m.cwiseProduct(p);
  const Eigen::VectorXd r2 = problem.compliances().cwiseProduct(p) - problem.b * u;
  // entry by entry: Eigen's products would copy A1 and B, beside the factor
  KktParts parts{problem.load - problem.a1 * u - problem.b.transpose() * stress,
                 problem.load.cwiseAbs(), problem.a1.diagonal().cwiseAbs()};
  for (Eigen::Index j = 0; j < problem.size(); ++j)
    for (SparseMatrix::InnerIterator a(problem.a1, j); a; ++a)
      parts.terms(a.row()) += std::abs(a.value() * u(j));
  for (Eigen::Index row = 0; row < r2.size(); ++row) {
    double unit = 0;
    for (RowMatrix::InnerIterator b(problem.b, row); b; ++b) {
      unit += std::abs(b.value());
      parts.terms(b.col()) += std::abs(b.value() * stress(row));
      parts.stiffness(b.col()) += b.value() * b.value() * problem.m(row);
    }
    parts.strain = max_or_nan(parts.strain, std::abs(r2(row)) / (unit == 0 ? 1 : unit));
  }
  return parts;
}

Eigen::VectorXd add_equations(Kkt& kkt, const KktParts& parts, const std::vector<char>& fixed,
                              double u, double force, double with_reactions) {
  // a great force somewhere must hide nothing where all forces are small
  const Eigen::VectorXd own = parts.terms.cwiseMax(u * parts.stiffness);
  Eigen::VectorXd forces = own.cwiseMin(force);
  kkt.residual = max_or_nan(kkt.residual, ratio(parts.strain, u));
  for (Eigen::Index i = 0; i < forces.size(); ++i) {
    if (fixed[i] != 0) {
      forces(i) = unbounded;  // the clamp carries any force
      continue;
    }
    // what the rounding of u and p alone may leave of r1 is no error: flat cells multiply it
    const double beyond =
        max_or_nan(std::abs(parts.r1(i)) - defaults::row_tolerance * parts.terms(i), 0);
    kkt.residual = max_or_nan(kkt.residual, ratio(beyond, std::min(own(i), with_reactions)));
  }
  return forces;
}

void add_bound(Kkt& kkt, const BoundLimits& bounds, int i, double value, double lambda,
               double reach, double force) {
  const double lower = bounds.lower(i), upper = bounds.upper(i), limit = bounds.force_limit(i);
  const bool soft = std::isfinite(limit);
  // between two bounds either sign of lambda is right, and each side answers for its own
  const bool two = std::isfinite(lower) && std::isfinite(upper);
  const double up = two ? std::max(lambda, 0.0) : lambda;
  const double down = two ? std::max(-lambda, 0.0) : -lambda;
  const auto side = [&](double bound, double gap, double pressure) {
    if (!std::isfinite(bound)) return;
    const double scale =
        std::max(reach, std::abs(bound));  // its own: a far obstacle hides no near one
    if (!two) kkt.min_pressure = min_or_nan(kkt.min_pressure, ratio(pressure, force));
    if (!soft) kkt.min_gap = min_or_nan(kkt.min_gap, ratio(gap, scale));
    // beyond a bound, the part of its limit that it does not use; a limit far above the forces at
    // work is not reached by round-off
    const bool beyond = soft && gap < 0;
    const double idle = beyond ? limit - pressure : pressure;
    const double unit = beyond ? std::max(force, limit) : force;
    kkt.complementarity =
        max_or_nan(kkt.complementarity, ratio(std::abs(idle * gap), scale * unit));
  };
  if (two) kkt.min_pressure = min_or_nan(kkt.min_pressure, ratio(std::abs(lambda), force));
  if (soft)
    kkt.min_pressure =
        min_or_nan(kkt.min_pressure, ratio(limit - std::abs(lambda), std::max(force, limit)));
  side(lower, value - lower, up);
  side(upper, upper - value, down);
}

Kkt kkt_report(const VariationalInequality& problem, const Solution& solution) {
  check_data(problem);
  check_sizes(problem, solution);
  const Eigen::VectorXd& u = solution.u;
  Kkt kkt;
  // Eigen's maxima may pass over what is not a number
  if (!u.allFinite() || !solution.p.allFinite() || !solution.lambda.allFinite()) {
    kkt.residual = unbounded;
    return kkt;
  }
  KktParts parts = kkt_parts(problem, u, solution.p);
  const double largest_force = add_bound_forces(parts, problem, solution.lambda);
  double with_reactions = largest_force;
  std::vector<char> fixed(problem.size(), 0);
  for (std::size_t i = 0; i < problem.dirichlet_dofs.size(); ++i) {
    const int unknown = problem.dirichlet_dofs[i];
    fixed[unknown] = 1;
    with_reactions = std::max(with_reactions, std::abs(parts.r1(unknown)));
    // the prescribed values hold exactly or not at all
    if (u(unknown) != problem.dirichlet_values(static_cast<Eigen::Index>(i))) kkt.residual = 1;
  }
  const double largest_u =
      std::max(u.lpNorm<Eigen::Infinity>(), KktTolerances{}.fail * solution.penalised_max_u);
  const Eigen::VectorXd forces =
      add_equations(kkt, parts, fixed, largest_u, largest_force, with_reactions);
  if (problem.bounds.count() > 0) add_bounds(kkt, problem.bounds, solution, largest_u, forces);
  return kkt;
}

double worst_violation(const Kkt& kkt) {
  const double worst =
      std::max({-kkt.min_gap, -kkt.min_pressure, kkt.complementarity, kkt.residual});
  const bool finite =
      std::isfinite(kkt.min_gap + kkt.min_pressure + kkt.complementarity + kkt.residual);
  return finite ? worst : unbounded;
}

void check_kkt(const VariationalInequality& problem, Solution& solution,
               const KktTolerances& levels) {
  solution.kkt = kkt_report(problem, solution);
  apply_tolerances(solution, levels);
}

void apply_tolerances(Solution& solution, const KktTolerances& levels) {
  const double worst = worst_violation(solution.kkt);
  const Kkt& k = solution.kkt;
  const std::string report = fmt::format(
      "smallest gap {:.1e}, smallest pressure {:.1e}, complementarity {:.1e}, residual {:.1e}",
      k.min_gap, k.min_pressure, k.complementarity, k.residual);
  const int steps = static_cast<int>(solution.history.size());
  if (!(worst <= levels.fail))
    throw NotConverged(
        fmt::format("{}: answer refused: the conditions hold only to {:.1e}, accepted {:.0e} ({})",
                    solution.solver, worst, levels.fail, report),
        worst, steps);
  if (worst > levels.warn)
    solution.warning += fmt::format("{}{}: the conditions hold to {:.1e}, trusted {:.0e} ({})",
                                    solution.warning.empty() ? "" : "; ", solution.solver, worst,
                                    levels.warn, report);
}

}  // namespace antilock
