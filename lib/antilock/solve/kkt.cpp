#include "antilock/solve/kkt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/detail/tuned.hpp"

namespace antilock {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// 0 / 0 is a condition met exactly.
double ratio(double value, double scale) { return value == 0 ? 0.0 : value / scale; }

/// The smaller and the larger one; not a number where one of them is not.
double least(double a, double b) { return std::isnan(a) || a < b ? a : b; }
double most(double a, double b) { return std::isnan(a) || a > b ? a : b; }

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

}  // namespace

KktParts kkt_parts(const VariationalInequality& problem, const Eigen::VectorXd& u, const Eigen::VectorXd& p) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.size());
  KktParts parts{problem.load, problem.load.cwiseAbs(), zero, zero, zero, zero};
  for (Eigen::Index j = 0; j < problem.a1.cols(); ++j)
    for (SparseMatrix::InnerIterator a(problem.a1, j); a; ++a) {
      const double term = a.value() * u(j);
      parts.moderate(a.row()) += term;
      parts.terms(a.row()) += std::abs(term);
      if (a.row() == j) parts.diagonal(j) = a.value();
    }
  for (Eigen::Index row = 0; row < problem.b.rows(); ++row) {
    const double m = problem.m(row), stress = m * p(row);
    double strain = 0, unit = 0;
    for (RowMatrix::InnerIterator b(problem.b, row); b; ++b) {
      const double term = b.value() * stress;
      strain += b.value() * u(b.col());
      unit += std::abs(b.value());
      parts.borne(b.col()) += term;
      parts.terms(b.col()) += std::abs(term);
      parts.stiff(b.col()) += b.value() * b.value() * m;
    }
    parts.strain = most(parts.strain, std::abs(problem.compliance * p(row) - strain) / (unit == 0 ? 1 : unit));
  }
  return parts;
}

KktRows::KktRows(const KktParts& parts, const Eigen::VectorXd& bounds, const Eigen::VectorXd& largest_bound,
                 const std::vector<char>& fixed, double largest_u, double reaction,
                 const std::function<double(double)>& over_all) {
  // a locked u may tend to 0: then what a load, as far as neither lambda nor B' M p bears it, would give its unknown if
  // all the others were held tells what is large
  double single = 0;
  const Eigen::VectorXd pulled = parts.load + bounds, r1 = pulled - parts.moderate - parts.borne;
  for (Eigen::Index i = 0; i < pulled.size(); ++i) {
    if (fixed[i] != 0) reaction = std::max(reaction, std::abs(r1(i)));  // a force, not an error
    if (fixed[i] == 0 && parts.diagonal(i) > 0)
      single =
          std::max(single, std::min(std::abs(pulled(i)), std::abs(pulled(i) - parts.borne(i))) / parts.diagonal(i));
  }
  const auto largest = [](const Eigen::VectorXd& v) { return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0; };
  u = over_all(std::max(largest_u, single));
  const double most_force = over_all(std::max(largest(parts.load), largest(largest_bound)));
  const double with_reactions = std::max(most_force, over_all(reaction));
  // a great force somewhere must hide nothing where all forces are small
  const Eigen::VectorXd own =
      parts.terms.cwiseMax(u * (parts.diagonal.cwiseAbs() + parts.stiff)).cwiseMax(largest_bound);
  forces = own.cwiseMin(most_force);
  for (Eigen::Index i = 0; i < own.size(); ++i) {
    if (fixed[i] != 0) {
      forces(i) = unbounded;  // the clamp bears any
      continue;
    }
    // what the rounding of u and p alone may leave of r1 is no error: flat cells multiply it
    const double beyond = most(std::abs(r1(i)) - tuned::equal * parts.terms(i), 0);
    residual = most(residual, ratio(beyond, std::min(own(i), with_reactions)));
  }
  residual = over_all(most(residual, ratio(parts.strain, u)));
}

void KktRows::note_bound(Kkt& kkt, const Stairs& stairs, int i, double value, double lambda, double strain,
                         double force) const {
  const double lower = stairs.lower(i), upper = stairs.above(i), bears = stairs.most(i);
  const bool soft = std::isfinite(bears);
  // between two bounds either sign of lambda is right, and each side answers for its own
  const bool two = std::isfinite(lower) && std::isfinite(upper);
  const double up = two ? std::max(lambda, 0.0) : lambda, down = two ? std::max(-lambda, 0.0) : -lambda;
  const auto side = [&](double bound, double gap, double pressure) {
    if (!std::isfinite(bound)) return;
    const double scale = std::max(u * strain, std::abs(bound));
    if (!two) kkt.min_pressure = least(kkt.min_pressure, ratio(pressure, force));
    if (!soft) kkt.min_gap = least(kkt.min_gap, ratio(gap, scale));
    // what is not borne beyond a bound; a bound that bears far more than the forces at work is not passed by round-off
    const bool beyond = soft && gap < 0;
    const double idle = beyond ? bears - pressure : pressure, unit = beyond ? std::max(force, bears) : force;
    kkt.complementarity = most(kkt.complementarity, ratio(std::abs(idle * gap), scale * unit));
  };
  if (two) kkt.min_pressure = least(kkt.min_pressure, ratio(std::abs(lambda), force));
  if (soft) kkt.min_pressure = least(kkt.min_pressure, ratio(bears - std::abs(lambda), std::max(force, bears)));
  side(lower, value - lower, up);
  side(upper, upper - value, down);
}

Kkt kkt_report(const VariationalInequality& problem, const Solution& solution) {
  check_data(problem);
  const Eigen::VectorXd &u = solution.u, &p = solution.p, &lambda = solution.lambda;
  if (u.size() != problem.size() || p.size() != problem.b.rows() || lambda.size() != problem.bound_count())
    throw Error(fmt::format("kkt: u, p and lambda have {}, {} and {} entries; accepted {}, {} and {}", u.size(),
                            p.size(), lambda.size(), problem.size(), problem.b.rows(), problem.bound_count()));
  Kkt kkt;
  if (!u.allFinite() || !p.allFinite() || !lambda.allFinite()) {  // Eigen's maxima may pass over what is not a number
    kkt.residual = unbounded;
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
  kkt.residual = moved ? std::max(rows.residual, 1.0) : rows.residual;
  if (problem.bound_count() == 0) return kkt;
  const Stairs stairs{problem.lower, problem.upper, problem.force_bound};
  const Eigen::VectorXd values = bounded_values(problem, u);
  const int contact = static_cast<int>(problem.contact.size());
  kkt.min_gap = kkt.min_pressure = unbounded;
  for (int i = 0; i < contact; ++i)
    rows.note_bound(kkt, stairs, i, values(i), lambda(i), 1, rows.forces(problem.contact[i]));
  for (int i = contact; i < stairs.count(); ++i) {  // each combination in its own units
    double strain = 0, force = unbounded;
    for (RowMatrix::InnerIterator c(problem.combinations, i - contact); c; ++c) {
      if (c.value() == 0) continue;
      strain += std::abs(c.value());
      force = std::min(force, rows.forces(c.col()) / std::abs(c.value()));
    }
    rows.note_bound(kkt, stairs, i, values(i), lambda(i), strain, force);
  }
  if (kkt.min_gap == unbounded) kkt.min_gap = 0;  // every bound gives way
  return kkt;
}

double worst_violation(const Kkt& kkt) {
  const double worst = std::max({-kkt.min_gap, -kkt.min_pressure, kkt.complementarity, kkt.residual});
  const bool finite = std::isfinite(kkt.min_gap + kkt.min_pressure + kkt.complementarity + kkt.residual);
  return finite ? worst : unbounded;
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
