#include "antilock/solve/iterated_penalty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/solve/anderson.hpp"
#include "antilock/solve/kkt.hpp"

namespace antilock {
namespace {

constexpr int patience = 15;              // corrections before a change of means: a factor costs about as much
constexpr double smallest_delta = 1e-13;  // below, K has too few digits of A1 left to contract at all

/// One correction: du on all unknowns, and the contact forces, from the residual r on the free places.
Eigen::VectorXd correct(const VariationalInequality& problem, PenaltyFactor& factor, const Eigen::VectorXd& u,
                        double u_scale, const Eigen::VectorXd& r, const Eigen::MatrixXd& schur,
                        const ContactSolver& contact, int correction, ContactAnswer& answer, SolveSeconds& seconds) {
  const FreeNumbering& numbering = factor.numbering();
  const auto c = static_cast<Eigen::Index>(problem.contact.size());
  Stopwatch watch;
  Eigen::VectorXd y = factor.forward(r);
  seconds.solve += watch.lap();
  if (c > 0) {
    // L_C y_C is the residual condensed on Gamma_C; v = du_C counts from u_C, so that no S u_C brings its round-off in
    const auto l = factor.contact_block().triangularView<Eigen::Lower>();
    const Eigen::VectorXd u_c = u(problem.contact), lower = problem.lower - u_c;
    Eigen::VectorXd q = l * y.tail(c);
    if (answer.lambda.size() > 0) q -= answer.lambda;  // r holds the forces so far, the contact problem asks for all
    answer = contact({schur, q, lower, u_scale, u_c}, answer, correction);
    y.tail(c) = l.transpose() * answer.v;
    seconds.contact += watch.lap();
  }
  const Eigen::VectorXd x = factor.backward(y);
  Eigen::VectorXd du = Eigen::VectorXd::Zero(problem.size());
  du(numbering.unknown) = x;
  seconds.solve += watch.lap();
  return du;
}

/// Whether the round-off of the residual, the same at each correction, would stay in u unseen: some unknown is a
/// thousand times as stiff as the median, as the corners of flat triangles are, or hardly anything holds the structure
/// (of A1 alone the pivots tell; those of a penalised K lie apart by nature).
bool needs_care(const VariationalInequality& problem, PenaltyFactor& factor) {
  if (problem.b.rows() == 0 && factor.rcond() < 1e-6) return true;
  Eigen::VectorXd stiffness = problem.a1.diagonal();
  const auto middle = stiffness.begin() + stiffness.size() / 2;
  std::nth_element(stiffness.begin(), middle, stiffness.end());
  return *std::max_element(middle, stiffness.end()) > 1e3 * *middle;
}

/// S = L_C L_C', C x C.
Eigen::MatrixXd contact_schur(const PenaltyFactor& factor) {
  const Eigen::MatrixXd& block = factor.contact_block();
  if (block.size() == 0) return block;  // no contact: Eigen's triangular product would read what is not there
  return block.triangularView<Eigen::Lower>() * block.transpose();
}

}  // namespace

CorrectionOptions corrections_to(double asked) {
  CorrectionOptions options;
  options.tolerance = asked;
  options.refused = std::max(options.refused, 10 * asked);
  return options;
}

Solution iterated_penalty(const VariationalInequality& problem, PenaltyFactor& factor, const ContactSolver& contact,
                          const CorrectionOptions& options, const std::string& name) {
  factor.check_fits(problem);
  const auto rows = problem.b.rows();
  double delta = factor.delta();
  Solution s;
  s.solver = name;
  s.u = Eigen::VectorXd::Zero(problem.size());
  s.u(problem.fixed) = problem.fixed_values;
  s.p = Eigen::VectorXd::Zero(rows);
  s.lambda = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.contact.size()));
  const int solves_before = factor.solves;

  Stopwatch watch;
  Eigen::MatrixXd schur = contact_schur(factor);
  s.seconds.contact += watch.lap();

  Anderson acceleration(6);
  ContactAnswer answer;
  const Eigen::VectorXd b_scale = absolute_row_sums(problem.b);
  double u_first = 0, u_scale = 0, before = 0, error = 1, gap = 1;
  int since_change = 0;                        // corrections with these means
  bool careful = needs_care(problem, factor);  // residuals in long double
  for (int correction = 0;; ++correction) {
    if (correction > options.max_corrections)
      throw NotConverged(
          fmt::format(
              "{}: not converged, or infeasible: after {} corrections the estimated relative error of u is {:.1e} "
              "and compliance p = B u holds to {:.1e}, accepted {:.0e}",
              name, correction - 1, error, gap, options.tolerance),
          std::max(error, gap), correction - 1);
    if (since_change > patience) {
      // Where du no longer falls it drowns in the round-off of the residual (slivers): more digits help. Where it falls
      // slowly, cells are far narrower than the mean: a smaller delta helps.
      const bool falling = before < 0.5 * s.history[s.history.size() - 6];
      const double smaller = std::max({problem.compliance, delta / 64, smallest_delta});
      if ((falling || careful) && smaller < delta) {
        factor.refactor(problem, delta = smaller);
        schur = contact_schur(factor);
      } else {
        careful = true;
      }
      acceleration.restart();
      since_change = 0;
    }
    ++since_change;
    // with the contact forces so far: where they are far above the load, r without them would keep none of its digits
    SplitResidual residual = careful ? extended_residual(problem, s.u, s.p, answer.lambda)
                                     : split_residual(problem, s.u, s.p, answer.lambda);
    if (rows > 0) residual.r1 += problem.b.transpose() * problem.m.cwiseProduct(residual.r2) / delta;
    const Eigen::VectorXd r = residual.r1(factor.numbering().unknown);
    const std::vector<bool> active_before = answer.active;
    const Eigen::VectorXd du = correct(problem, factor, s.u, u_scale, r, schur, contact, correction, answer, s.seconds);
    s.u += du;
    Eigen::VectorXd dp;
    if (rows > 0) {
      dp = (problem.b * du - residual.r2) / delta;
      s.p += dp;
    }
    // du contracts like the error; the error left behind is du rate / (1 - rate)
    if (correction == 0) u_first = s.u.lpNorm<Eigen::Infinity>();
    // a locked u tends to 0, hence the first; one on its way to infinity (an infeasible problem) must not count for
    // long
    u_scale = std::max(u_first, s.u.lpNorm<Eigen::Infinity>());
    const double change = u_scale > 0 ? du.lpNorm<Eigen::Infinity>() / u_scale : 0;
    s.history.push_back(change);
    if (!std::isfinite(change))
      throw NotConverged(name + ": the iterated penalty broke down (not a number)", change, correction);
    s.counters.corrections = correction;
    if (u_scale == 0 || (rows == 0 && !careful)) break;  // without B, K is A1: the first solve is the answer
    // what compliance p - B u comes to now: where no u meets the bounds and B u = 0, u settles and this does not
    gap = std::abs(problem.compliance - delta) * dp.cwiseQuotient(b_scale).lpNorm<Eigen::Infinity>() / u_scale;
    if (correction > 0) {
      const double rate = change < before ? std::clamp(change / before, 0.01, 0.99) : 0.99;  // 0 / 0: settled
      error = change * rate / (1 - rate);
      if (error <= options.tolerance && gap <= 1e-3 * options.tolerance) break;
    }
    before = change;
    if (answer.active != active_before) acceleration.restart();
    if (rows > 0) acceleration.mix(s.p, dp, s.u);
  }
  s.counters.triangles = problem.triangles;
  s.counters.unknowns = problem.free_count();
  s.counters.factorisations = factor.factorisations;
  s.counters.solves = factor.solves - solves_before;
  s.seconds.analyse = factor.analyse_seconds;
  s.seconds.factor = factor.factor_seconds;
  s.lambda = answer.lambda.size() > 0 ? answer.lambda : s.lambda;
  s.active = answer.active;
  s.moderate = u_first;
  certify(problem, s, TrustLevels{.refused = options.refused});
  return s;
}

}  // namespace antilock
