#include "antilock/solve/kkt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/detail/kkt_rows.hpp"

namespace antilock {
namespace {

/// The report is asked of foreign answers too.
void require_sizes(const VariationalInequality& problem, const Solution& s) {
  if (s.u.size() == problem.size() && s.p.size() == problem.b.rows() && s.lambda.size() == problem.bound_count())
    return;
  throw Error(fmt::format("kkt: u, p and lambda have {}, {} and {} entries; accepted {}, {} and {}", s.u.size(),
                          s.p.size(), s.lambda.size(), problem.size(), problem.b.rows(), problem.bound_count()));
}

/// The largest force of a single bound on each unknown, N.
Eigen::VectorXd largest_bound_forces(const VariationalInequality& problem, const Eigen::VectorXd& lambda) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(problem.size());
  const auto contact = static_cast<Eigen::Index>(problem.contact.size());
  for (Eigen::Index i = 0; i < contact; ++i) largest(problem.contact[i]) = std::abs(lambda(i));
  for (Eigen::Index row = 0; row < problem.combinations.rows(); ++row)
    for (RowMatrix::InnerIterator c(problem.combinations, row); c; ++c)
      largest(c.col()) = std::max(largest(c.col()), std::abs(c.value() * lambda(contact + row)));
  return largest;
}

/// min_gap, min_pressure and complementarity, each bound in its own units.
void report_bounds(Kkt& kkt, const VariationalInequality& problem, const Solution& solution, const KktRows& rows) {
  if (problem.bound_count() == 0) return;
  const Stairs stairs{problem.lower, problem.upper, problem.force_bound};
  const Eigen::VectorXd values = bounded_values(problem, solution.u);
  const int contact = static_cast<int>(problem.contact.size());
  kkt.min_gap = kkt.min_pressure = std::numeric_limits<double>::infinity();
  for (int i = 0; i < stairs.count(); ++i) {
    double strain = i < contact ? 1 : 0;
    double force = i < contact ? rows.forces()(problem.contact[i]) : std::numeric_limits<double>::infinity();
    if (i >= contact)
      for (RowMatrix::InnerIterator c(problem.combinations, i - contact); c; ++c) {
        if (c.value() == 0) continue;
        strain += std::abs(c.value());
        force = std::min(force, rows.forces()(c.col()) / std::abs(c.value()));
      }
    rows.note_bound(kkt, stairs, i, values(i), solution.lambda(i), strain, force);
  }
  if (kkt.min_gap == std::numeric_limits<double>::infinity()) kkt.min_gap = 0;  // every bound gives way
}

}  // namespace

Kkt kkt_report(const VariationalInequality& problem, const Solution& solution) {
  check_data(problem);
  require_sizes(problem, solution);
  return kkt_report_unchecked(problem, solution);
}

Kkt kkt_report_unchecked(const VariationalInequality& problem, const Solution& solution) {
  const Eigen::VectorXd &u = solution.u, &p = solution.p, &lambda = solution.lambda;
  Kkt kkt;
  if (!u.allFinite() || !p.allFinite() || !lambda.allFinite()) {  // Eigen's maxima may pass over what is not a number
    kkt.residual = std::numeric_limits<double>::infinity();
    return kkt;
  }
  std::vector<char> fixed(problem.size(), 0);
  bool moved = false;
  for (std::size_t i = 0; i < problem.fixed.size(); ++i) {
    fixed[problem.fixed[i]] = 1;
    moved = moved || u(problem.fixed[i]) != problem.fixed_values(static_cast<Eigen::Index>(i));
  }
  const KktRows rows(kkt_parts(problem, u, p), bound_forces(problem, lambda), largest_bound_forces(problem, lambda),
                     fixed, std::max(u.lpNorm<Eigen::Infinity>(), TrustLevels{}.refused * solution.moderate), 0,
                     [](double value) { return value; });
  // the prescribed values hold exactly or not at all
  kkt.residual = moved ? std::max(rows.residual(), 1.0) : rows.residual();
  report_bounds(kkt, problem, solution, rows);
  return kkt;
}

double worst_violation(const Kkt& kkt) {
  const double worst = std::max({-kkt.min_gap, -kkt.min_pressure, kkt.complementarity, kkt.residual});
  const bool finite = std::isfinite(kkt.min_gap + kkt.min_pressure + kkt.complementarity + kkt.residual);
  return finite ? worst : std::numeric_limits<double>::infinity();
}

void certify(const VariationalInequality& problem, Solution& solution, const TrustLevels& levels) {
  solution.kkt = kkt_report(problem, solution);
  require_trusted(solution, levels);
}

void require_trusted(Solution& solution, const TrustLevels& levels) {
  const double worst = worst_violation(solution.kkt);
  const Kkt& k = solution.kkt;
  const std::string report =
      fmt::format("smallest gap {:.1e}, smallest pressure {:.1e}, complementarity {:.1e}, residual {:.1e}", k.min_gap,
                  k.min_pressure, k.complementarity, k.residual);
  const int steps = static_cast<int>(solution.history.size());
  if (!(worst <= levels.refused))
    throw NotConverged(fmt::format("{}: answer refused: the conditions hold only to {:.1e}, accepted {:.0e} ({})",
                                   solution.solver, worst, levels.refused, report),
                       worst, steps);
  if (worst > levels.trusted)
    solution.warning = fmt::format("{}: the conditions hold to {:.1e}, trusted {:.0e} ({})", solution.solver, worst,
                                   levels.trusted, report);
}

}  // namespace antilock
