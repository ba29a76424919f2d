#include "antilock/solve/kkt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/core/error.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/kkt_bounds.hpp"

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

/// The largest displacement that a load, as far as neither lambda nor B' M p bears it, would give its unknown if all the
/// others were held: a scale, from below.
double single_displacement(const VariationalInequality& problem, const Eigen::VectorXd& p,
                           const Eigen::VectorXd& lambda) {
  Eigen::VectorXd forces = problem.load + bound_forces(problem, lambda);
  if (problem.b.rows() > 0) {
    const Eigen::VectorXd net = forces - problem.b.transpose() * problem.m.cwiseProduct(p);
    forces = forces.cwiseAbs().cwiseMin(net.cwiseAbs());
  }
  const Eigen::VectorXd diagonal = problem.a1.diagonal();
  std::vector<char> fixed(problem.size(), 0);
  for (const int i : problem.fixed) fixed[i] = 1;
  double most = 0;
  for (Eigen::Index i = 0; i < diagonal.size(); ++i)
    if (diagonal(i) > 0 && !fixed[i]) most = std::max(most, std::abs(forces(i)) / diagonal(i));
  return most;
}

/// The residual with every product and sum in Scalar, rounded once at the end.
template <class Scalar>
SplitResidual residual_in(const VariationalInequality& problem, const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                          const Eigen::VectorXd& lambda) {
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  const Vector wide_u = u.cast<Scalar>(), wide_p = p.cast<Scalar>();
  Vector r1 = problem.load.cast<Scalar>();
  r1 -= problem.a1.cast<Scalar>() * wide_u;
  if (problem.b.rows() > 0) {
    const Vector stress = problem.m.cast<Scalar>().cwiseProduct(wide_p);
    r1 -= problem.b.cast<Scalar>().transpose() * stress;
  }
  if (lambda.size() > 0) {
    for (std::size_t i = 0; i < problem.contact.size(); ++i)
      r1(problem.contact[i]) += lambda(static_cast<Eigen::Index>(i));
    const Eigen::Index rows = problem.combinations.rows();
    if (rows > 0) r1 += problem.combinations.cast<Scalar>().transpose() * lambda.tail(rows).template cast<Scalar>();
  }
  Vector r2 = static_cast<Scalar>(problem.compliance) * wide_p;
  r2 -= problem.b.cast<Scalar>() * wide_u;
  return {r1.template cast<double>(), r2.template cast<double>()};
}

}  // namespace

SplitResidual split_residual(const VariationalInequality& problem, const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                             const Eigen::VectorXd& lambda) {
  return residual_in<double>(problem, u, p, lambda);
}

SplitResidual extended_residual(const VariationalInequality& problem, const Eigen::VectorXd& u,
                                const Eigen::VectorXd& p, const Eigen::VectorXd& lambda) {
  return residual_in<long double>(problem, u, p, lambda);
}

Eigen::VectorXd absolute_row_sums(const RowMatrix& b) {
  Eigen::VectorXd sums = b.cwiseAbs() * Eigen::VectorXd::Ones(b.cols());
  for (double& sum : sums)
    if (sum == 0) sum = 1;
  return sums;
}

Kkt kkt_report(const VariationalInequality& problem, const Solution& solution) {
  const Eigen::VectorXd &u = solution.u, &p = solution.p, &lambda = solution.lambda;
  check_data(problem);
  require_sizes(problem, solution);
  Kkt kkt;
  if (!u.allFinite() || !p.allFinite() || !lambda.allFinite()) {  // Eigen's maxima may pass over what is not a number
    kkt.residual = std::numeric_limits<double>::infinity();
    return kkt;
  }
  SplitResidual r = split_residual(problem, u, p, lambda);
  double reaction = 0;
  for (const int i : problem.fixed) {  // what the clamp bears: a force, not an error
    reaction = std::max(reaction, std::abs(r.r1(i)));
    r.r1(i) = 0;
  }
  const Eigen::VectorXd borne = largest_bound_forces(problem, lambda);
  const double f_scale = std::max(problem.load.lpNorm<Eigen::Infinity>(), borne.lpNorm<Eigen::Infinity>());
  // what the rounding of u and p alone may leave of r1 is no error: flat cells multiply it
  Eigen::VectorXd terms = problem.a1.cwiseAbs() * u.cwiseAbs() + problem.load.cwiseAbs();
  if (problem.b.rows() > 0) terms += problem.b.cwiseAbs().transpose() * problem.m.cwiseProduct(p.cwiseAbs());
  const Eigen::VectorXd beyond = (r.r1.cwiseAbs() - 8 * std::numeric_limits<double>::epsilon() * terms).cwiseMax(0);
  // a locked u may tend to 0: then its size before, or what the loads would do to one free unknown, tells what is large
  const double u_scale =
      std::max({u.lpNorm<Eigen::Infinity>(), 1e-6 * solution.moderate, single_displacement(problem, p, lambda)});
  // a great force somewhere must hide nothing where all forces are small
  Eigen::VectorXd own = problem.a1.diagonal().cwiseAbs();
  if (problem.b.rows() > 0) own += problem.b.cwiseAbs2().transpose() * problem.m;
  own = terms.cwiseMax(u_scale * own).cwiseMax(borne);
  for (Eigen::Index i = 0; i < beyond.size(); ++i)
    kkt.residual = most(kkt.residual, ratio(beyond(i), std::min(own(i), std::max(f_scale, reaction))));
  const Eigen::VectorXd strain = r.r2.cwiseQuotient(absolute_row_sums(problem.b));
  kkt.residual = most(kkt.residual, ratio(strain.lpNorm<Eigen::Infinity>(), u_scale));
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
