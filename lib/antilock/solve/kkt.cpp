#include "antilock/solve/kkt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/scene/error.hpp"

namespace antilock {
namespace {

double largest(const Eigen::VectorXd& v) { return v.size() == 0 ? 0.0 : v.cwiseAbs().maxCoeff(); }

double ratio(double value, double scale) {
  return value == 0 ? 0.0 : value / scale;
}  // 0 / 0 is a condition met exactly

}  // namespace

SplitResidual split_residual(const VariationalInequality& problem, const Eigen::VectorXd& u, const Eigen::VectorXd& p,
                             const Eigen::VectorXd& lambda) {
  SplitResidual r;
  r.r1 = problem.load - problem.a1 * u;
  if (problem.b.rows() > 0) r.r1 -= problem.b.transpose() * problem.m.cwiseProduct(p);
  for (Eigen::Index i = 0; i < lambda.size(); ++i) r.r1(problem.contact[i]) += lambda(i);
  r.r2 = problem.compliance * p - problem.b * u;
  return r;
}

Kkt kkt_report(const VariationalInequality& problem, const Solution& solution) {
  const Eigen::VectorXd &u = solution.u, &p = solution.p, &lambda = solution.lambda;
  Kkt kkt;
  if (!u.allFinite() || !p.allFinite() || !lambda.allFinite()) {  // a maximum may pass over what is not a number
    kkt.residual = std::numeric_limits<double>::infinity();
    return kkt;
  }
  SplitResidual r = split_residual(problem, u, p, lambda);
  for (const int i : problem.fixed) r.r1(i) = 0;  // the reaction of the clamp, not an error
  Eigen::VectorXd terms = problem.a1.cwiseAbs() * u.cwiseAbs() + problem.load.cwiseAbs();
  double b_largest = 0;
  if (problem.b.rows() > 0) {
    terms += problem.b.cwiseAbs().transpose() * problem.m.cwiseProduct(p.cwiseAbs());
    b_largest = Eigen::Map<const Eigen::VectorXd>(problem.b.valuePtr(), problem.b.nonZeros()).cwiseAbs().maxCoeff();
  }
  // a locked u may tend to 0: then the bounds tell what is large
  const double u_largest = largest(u), u_scale = std::max(u_largest, largest(problem.lower));
  const double f_scale = std::max(largest(problem.load), largest(lambda));
  kkt.residual = std::max(ratio(largest(r.r1), largest(terms)),
                          ratio(largest(r.r2), std::max(b_largest * u_scale, problem.compliance * largest(p))));
  // the prescribed values hold exactly or not at all
  for (std::size_t i = 0; i < problem.fixed.size(); ++i)
    if (u(problem.fixed[i]) != problem.fixed_values(static_cast<Eigen::Index>(i)))
      kkt.residual = std::max(kkt.residual, 1.0);
  if (problem.contact.empty()) return kkt;
  kkt.min_pressure = ratio(lambda.minCoeff(), f_scale);
  kkt.min_gap = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < lambda.size(); ++i) {  // each gap by its own bound: a far obstacle hides no near one
    const double gap = u(problem.contact[i]) - problem.lower(i),
                 scale = std::max(u_largest, std::abs(problem.lower(i)));
    kkt.min_gap = std::min(kkt.min_gap, ratio(gap, scale));
    kkt.complementarity = std::max(kkt.complementarity, ratio(std::abs(lambda(i) * gap), scale * f_scale));
  }
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
