#include "antilock/solve/kkt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/kkt_bounds.hpp"
#include "antilock/solve/residual.hpp"

namespace antilock {
namespace {

using scale_free::most;
using scale_free::ratio;

/// The report is asked of foreign answers too.
void require_sizes(const VariationalInequality& problem, const Solution& s) {
  if (s.u.size() == problem.size() && s.p.size() == problem.b.rows() && s.lambda.size() == problem.bound_count())
    return;
  throw Error(fmt::format("kkt: u, p and lambda have {}, {} and {} entries; accepted {}, {} and {}", s.u.size(),
                          s.p.size(), s.lambda.size(), problem.size(), problem.b.rows(), problem.bound_count()));
}

/// What the report compares, found in one walk over A1 and one over B.
struct Parts {
  Eigen::VectorXd r1;        ///< N, the residual of the forces
  Eigen::VectorXd terms;     ///< N, the sum of the absolute values of its terms but lambda
  Eigen::VectorXd borne;     ///< N, (B' M p)_i
  Eigen::VectorXd diagonal;  ///< N, of A1
  Eigen::VectorXd stiff;     ///< N, the diagonal of B' M B
  double strain = 0;         ///< the largest |r2| in units of its row
};

Parts parts(const VariationalInequality& problem, const Solution& s) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.size());
  Parts parts{problem.load, problem.load.cwiseAbs(), zero, zero, zero};
  for (Eigen::Index j = 0; j < problem.a1.cols(); ++j)
    for (SparseMatrix::InnerIterator a(problem.a1, j); a; ++a) {
      const double term = a.value() * s.u(j);
      parts.r1(a.row()) -= term;
      parts.terms(a.row()) += std::abs(term);
      if (a.row() == j) parts.diagonal(j) = a.value();
    }
  for (Eigen::Index row = 0; row < problem.b.rows(); ++row) {
    const double m = problem.m(row), stress = m * s.p(row);
    double strain = 0, unit = 0;
    for (RowMatrix::InnerIterator b(problem.b, row); b; ++b) {
      const double term = b.value() * stress;
      strain += b.value() * s.u(b.col());
      unit += std::abs(b.value());
      parts.borne(b.col()) += term;
      parts.terms(b.col()) += std::abs(term);
      parts.stiff(b.col()) += b.value() * b.value() * m;
    }
    const double r2 = std::abs(problem.compliance * s.p(row) - strain);
    parts.strain = most(parts.strain, unit == 0 ? r2 : r2 / unit);
  }
  parts.r1 -= parts.borne;
  if (s.lambda.size() > 0) parts.r1 += bound_forces(problem, s.lambda);
  return parts;
}

/// The largest displacement that a load, as far as neither lambda nor B' M p bears it, would give its unknown if all the
/// others were held: a scale, from below.
double single_displacement(const VariationalInequality& problem, const Parts& parts, const Eigen::VectorXd& lambda) {
  Eigen::VectorXd forces = problem.load;
  if (lambda.size() > 0) forces += bound_forces(problem, lambda);
  for (const int i : problem.fixed) forces(i) = 0;
  double largest = 0;
  for (Eigen::Index i = 0; i < forces.size(); ++i)
    if (parts.diagonal(i) > 0)
      largest =
          std::max(largest, std::min(std::abs(forces(i)), std::abs(forces(i) - parts.borne(i))) / parts.diagonal(i));
  return largest;
}

}  // namespace

SplitResidual split_residual(const VariationalInequality& problem, const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                             const Eigen::VectorXd& lambda) {
  return exact_residual(problem, u, p, lambda);
}

Eigen::VectorXd absolute_row_sums(const RowMatrix& b) {
  Eigen::VectorXd sums = b.cwiseAbs() * Eigen::VectorXd::Ones(b.cols());
  for (double& sum : sums)
    if (sum == 0) sum = 1;
  return sums;
}

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
  Parts part = parts(problem, solution);
  double reaction = 0;
  for (const int i : problem.fixed) {  // what the clamp bears: a force, not an error
    reaction = std::max(reaction, std::abs(part.r1(i)));
    part.r1(i) = 0;
  }
  const Eigen::VectorXd borne = largest_bound_forces(problem, lambda);
  const double f_scale = std::max(problem.load.lpNorm<Eigen::Infinity>(), borne.lpNorm<Eigen::Infinity>());
  // a locked u may tend to 0: then its size before, or what the loads would do to one free unknown, tells what is large
  const double u_scale =
      std::max({u.lpNorm<Eigen::Infinity>(), 1e-6 * solution.moderate, single_displacement(problem, part, lambda)});
  // a great force somewhere must hide nothing where all forces are small
  Eigen::VectorXd own = part.terms.cwiseMax(u_scale * (part.diagonal.cwiseAbs() + part.stiff)).cwiseMax(borne);
  for (Eigen::Index i = 0; i < own.size(); ++i) {
    // what the rounding of u and p alone may leave of r1 is no error: flat cells multiply it
    const double beyond = most(std::abs(part.r1(i)) - 8 * std::numeric_limits<double>::epsilon() * part.terms(i), 0);
    kkt.residual = most(kkt.residual, ratio(beyond, std::min(own(i), std::max(f_scale, reaction))));
  }
  kkt.residual = most(kkt.residual, ratio(part.strain, u_scale));
  // the prescribed values hold exactly or not at all
  for (std::size_t i = 0; i < problem.fixed.size(); ++i)
    if (u(problem.fixed[i]) != problem.fixed_values(static_cast<Eigen::Index>(i)))
      kkt.residual = std::max(kkt.residual, 1.0);
  report_bounds(kkt, problem, solution, u_scale, own.cwiseMin(f_scale));
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
