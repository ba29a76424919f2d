#include "antilock/solve/penalty_factor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/detail/tied.hpp"
#include "antilock/solve/tuned.hpp"

namespace antilock {
namespace {

const VariationalInequality& checked(const VariationalInequality& problem) {
  check(problem);
  return problem;
}

/// Equal bit for bit, stored zeros and all: one walk over both.
template <class Sparse>
bool same(const Sparse& one, const Sparse& other) {
  const auto equal = [](const auto* a, const auto* b, Eigen::Index count) { return std::equal(a, a + count, b); };
  const Eigen::Index n = one.nonZeros();
  return one.rows() == other.rows() && one.cols() == other.cols() && n == other.nonZeros() &&
         equal(one.valuePtr(), other.valuePtr(), n) && equal(one.innerIndexPtr(), other.innerIndexPtr(), n) &&
         equal(one.outerIndexPtr(), other.outerIndexPtr(), one.outerSize());
}

/// Whether the contact problem takes the sparse road (see ContactRoad).
bool takes_sparse(ContactRoad road, const FreeNumbering& numbering) {
  const int bounded = numbering.contact();
  if (road != ContactRoad::automatic) return bounded > 0 && road == ContactRoad::sparse;
  return bounded > 10 * std::sqrt(numbering.unknown.size());
}

}  // namespace

PenaltyFactor::PenaltyFactor(const VariationalInequality& problem, std::optional<double> penalty, ContactRoad road,
                             CholeskyMaker make)
    : first_delta_(moderate_delta(checked(problem), penalty)),
      of_(*Tied(problem, first_delta_)),
      numbering_(of_),
      sparse_(takes_sparse(road, numbering_)),
      factor_(make) {
  refactor(first_delta_);
}

void PenaltyFactor::check_fits(const VariationalInequality& problem) const { tied(problem); }

Tied PenaltyFactor::tied(const VariationalInequality& problem) const {
  check_data(problem);
  Tied tied(problem, first_delta_);
  const FreeNumbering other(*tied);
  if (other.unknown != numbering_.unknown || other.interior != numbering_.interior)
    throw Error(
        fmt::format("solve: the factor is of {} free unknowns, {} of them in contact, the problem has {} and {}; "
                    "accepted: the factor of a problem with the same free and contact unknowns",
                    numbering_.unknown.size(), numbering_.contact(), other.unknown.size(), other.contact()));
  const Eigen::VectorXd &own = tied->own_compliances, &of_factor = of_.own_compliances;
  if (!same(tied->a1, of_.a1) || !same(tied->b, of_.b) || tied->m != of_.m || own.size() != of_factor.size() ||
      own != of_factor)
    throw Error("solve: the factor is of another A1, B or M; accepted: the factor of this problem's matrices");
  return tied;
}

void PenaltyFactor::refactor(double delta) {
  if (!(delta > 0 && std::isfinite(delta)))
    throw Error(fmt::format("solve: delta = {}; accepted: a positive number", delta));
  double own = of_.own_compliances.size() > 0 ? tuned::own_penalty * std::min(delta, choose_penalty(of_)) : delta;
  for (delta_ = 0; delta_ == 0; delta *= tuned::next_penalty, own *= tuned::next_penalty) {
    penalties_ = row_penalties(of_, delta, own);
    const std::optional<int> lost =
        factor_.factorise(penalised_matrix(of_, numbering_, penalties_), sparse_ ? 0 : numbering_.contact());
    if (!lost) delta_ = delta;
    // a larger penalty leaves the factor more digits of A1, until nothing is stiff beside it any more
    else if (of_.b.rows() == 0 || !(delta < first_delta_ / usual_penalty))
      throw Error(fmt::format(
          "solve: A1 + B' M B / {:.3g} is not positive definite (at unknown {}): a part of the structure is held "
          "by nothing, a cell is too flat for double precision, or A1 and B are in units far apart; accepted: enough "
          "fixed unknowns, cells, entries of A1 and B' M B of like size",
          delta, numbering_.unknown[*lost]));
  }
  if (sparse_) return;
  const Stopwatch watch;
  contact_block_ = factor_.cholesky().trailing_block(numbering_.interior);
  schur_ = contact_block_.triangularView<Eigen::Lower>() * contact_block_.transpose();
  schur_seconds_ = watch.seconds();
}

const SparseCholesky& PenaltyFactor::dense() const {
  if (sparse_)
    throw Error(
        fmt::format("solve: this factor of {} bounds among {} unknowns has no dense contact block; accepted: a factor "
                    "made with ContactRoad::dense",
                    numbering_.contact(), numbering_.unknown.size()));
  return factor_.cholesky();
}

}  // namespace antilock
