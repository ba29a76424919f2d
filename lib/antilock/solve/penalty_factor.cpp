#include "antilock/solve/penalty_factor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/detail/tied.hpp"
#include "antilock/solve/detail/tuned.hpp"

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
  const auto all = static_cast<double>(numbering.unknown.size()), bounded = all - numbering.interior;
  if (bounded == 0 || road != ContactRoad::automatic) return bounded > 0 && road == ContactRoad::sparse;
  return bounded > 600 && bounded > 8 * std::sqrt(all);
}

}  // namespace

PenaltyFactor::PenaltyFactor(const VariationalInequality& problem, std::optional<double> penalty, ContactRoad road,
                             CholeskyMaker make)
    : PenaltyFactor(Tied(checked(problem)), moderate_delta(problem, penalty), road, make) {}

PenaltyFactor::PenaltyFactor(const Tied& problem, double delta, ContactRoad road, CholeskyMaker make)
    : numbering_(*problem),
      a1_(problem->a1),
      b_(problem->b),
      m_(problem->m),
      first_delta_(delta),
      sparse_(takes_sparse(road, numbering_)),
      factor_(make) {
  // a larger penalty leaves the factor more digits of A1, until nothing is stiff beside it any more
  for (;; delta *= tuned::next_penalty) try {
      factorise(*problem, delta);
      break;
    } catch (const Error&) {
      if (problem->b.rows() == 0 || !(delta < first_delta_ / usual_penalty)) throw;
    }
}

void PenaltyFactor::check_fits(const VariationalInequality& problem) const {
  check_data(problem);
  const Tied tied(problem);
  check_unknowns(*tied);
  if (!owns(*tied))
    throw Error("solve: the factor is of another A1, B or M; accepted: the factor of this problem's matrices");
}

bool PenaltyFactor::owns(const VariationalInequality& problem) const {
  return same(problem.a1, a1_) && same(problem.b, b_) && problem.m == m_;
}

void PenaltyFactor::check_unknowns(const VariationalInequality& problem) const {
  const FreeNumbering other(problem);
  if (other.unknown != numbering_.unknown || other.interior != numbering_.interior)
    throw Error(
        fmt::format("solve: the factor is of {} free unknowns, {} of them in contact, the problem has {} and {}; "
                    "accepted: the factor of a problem with the same free and contact unknowns",
                    numbering_.unknown.size(), numbering_.unknown.size() - numbering_.interior, other.unknown.size(),
                    problem.contact.size()));
}

void PenaltyFactor::refactor(const VariationalInequality& of, double delta) {
  const Tied problem(of);
  if (!owns(*problem)) {
    check(of);
    a1_ = problem->a1, b_ = problem->b, m_ = problem->m;
  }
  check_unknowns(*problem);
  factorise(*problem, delta);
}

void PenaltyFactor::factorise(const VariationalInequality& problem, double delta) {
  if (!(delta > 0 && std::isfinite(delta)))
    throw Error(fmt::format("solve: delta = {}; accepted: a positive number", delta));
  delta_ = delta;
  deltas_.setConstant(problem.b.rows(), delta);
  deltas_.tail(problem.ties).setConstant(delta / first_delta_);
  const int contact = static_cast<int>(numbering_.unknown.size()) - numbering_.interior;
  const std::optional<int> lost =
      factor_.factorise(penalised_matrix(problem, numbering_, deltas_), sparse_ ? 0 : contact);
  if (lost)
    throw Error(fmt::format(
        "solve: A1 + B' M B / {:.3g} is not positive definite (at unknown {}): a part of the structure is held "
        "by nothing, a cell is too flat for double precision, or A1 and B are in units far apart; accepted: enough "
        "fixed unknowns, cells, entries of A1 and B' M B of like size",
        delta, numbering_.unknown[*lost]));
  if (!sparse_) contact_block_ = factor_.cholesky().trailing_block(numbering_.interior);
}

const SparseCholesky& PenaltyFactor::dense() const {
  if (sparse_)
    throw Error(
        fmt::format("solve: this factor of {} bounds among {} unknowns has no dense contact block; accepted: a factor "
                    "made with ContactRoad::dense",
                    numbering_.unknown.size() - numbering_.interior, numbering_.unknown.size()));
  return factor_.cholesky();
}

}  // namespace antilock
