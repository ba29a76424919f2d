// How the corrections start, and the means that they change where those are not enough.
#include <algorithm>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/corrections.hpp"

namespace antilock {
namespace {

/// Corrections before a change of means. Measured at 1/h = 128: a new factor costs as much as 10 to 20 corrections.
constexpr int patience = 15;

/// By which a new penalty is smaller. A correction contracts like delta / (delta + sigma): 0.9 becomes 0.12.
constexpr double smaller_by = 64;

/// Whether the round-off of the residual, the same at each correction, would stay in u unseen: some unknown is a
/// thousand times as stiff as the median, as the corners of flat triangles are, or hardly anything holds the structure:
/// a pivot of K is below 1e-5 of what A1 has, so that 1e-16 becomes 1e-11 and more. (The pivots of a penalised K lie
/// apart by nature: they count beside A1, not beside the largest of K.) Then long double: three digits more.
bool needs_long_double(const VariationalInequality& problem, const PenaltyFactor& factor) {
  const Eigen::VectorXd stiffness = Eigen::VectorXd(problem.a1.diagonal())(factor.numbering().unknown);
  const double largest = stiffness.size() > 0 ? stiffness.maxCoeff() : 0;
  if (factor.smallest_pivot() < 1e-5 * largest) return true;
  return 2 * (1e3 * stiffness.array() < largest).count() > stiffness.size();
}

/// S = L_C L_C', C x C.
Eigen::MatrixXd contact_schur(PenaltyFactor& factor) {
  if (factor.held() != nullptr) return {};
  const Eigen::MatrixXd& block = factor.contact_block();
  if (block.size() == 0) return block;  // no contact: Eigen's triangular product would read what is not there
  return block.triangularView<Eigen::Lower>() * block.transpose();
}

}  // namespace

Corrections::Corrections(const VariationalInequality& problem, PenaltyFactor& factor, const CorrectionOptions& options,
                         std::string name)
    : problem_(problem),
      factor_(factor),
      options_(options),
      row_sums_(absolute_row_sums(problem.b)),
      long_double_(needs_long_double(problem, factor)) {
  s_.solver = std::move(name);
  s_.u = Eigen::VectorXd::Zero(problem.size());
  s_.u(problem.fixed) = problem.fixed_values;
  s_.p = Eigen::VectorXd::Zero(problem.b.rows());
  s_.lambda = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.contact.size()));
  s_.counters.solves = factor.solves;  // `finished` takes it off again
  const Stopwatch watch;
  schur_ = contact_schur(factor);
  s_.seconds.contact = watch.seconds();
}

// Two things keep corrections from settling, and du tells them apart:
// - du no longer falls: it drowns in the round-off of the residual, as on slivers. Residuals in long double help.
// - du falls, but slowly: delta is not small beside sigma, as where cells are far narrower than the mean, or where a
//   locked element leaves B nearly dependent. A smaller delta helps, until the factor has no digit of A1 left. On flat
//   triangles it may lose its pivots before: then the corrections go on with the delta that they had, in long double.
void Corrections::rescue() {
  if (since_rescue_++ <= patience) return;
  const double delta = factor_.delta();
  const double smaller =
      std::max({problem_.compliance, delta / smaller_by, std::min(delta, smallest_penalty(problem_)), least_delta_});
  const bool falling = s_.history.back() < 0.5 * s_.history[s_.history.size() - 6];
  if (!(falling || long_double_) || smaller >= delta) {
    long_double_ = true;
  } else {
    try {
      refactor(smaller);
    } catch (const Error&) {
      least_delta_ = delta;
      long_double_ = true;
      refactor(delta);
    }
  }
  acceleration_.restart();
  since_rescue_ = 1;
}

void Corrections::refactor(double delta) {
  factor_.refactor(problem_, delta);
  schur_ = contact_schur(factor_);
}

}  // namespace antilock
