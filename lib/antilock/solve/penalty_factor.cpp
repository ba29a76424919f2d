#include "antilock/solve/penalty_factor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/detail/default_cholesky.hpp"
#include "antilock/solve/detail/tied.hpp"

namespace antilock {
namespace {

const VariationalInequality& checked(const VariationalInequality& problem) {
  check(problem);
  return problem;
}

/// Equal bit for bit, stored zeros and all: one walk over both.
template <class Sparse>
bool same(const Sparse& one, const Sparse& other) {
  const Eigen::Index n = one.nonZeros();
  return one.rows() == other.rows() && one.cols() == other.cols() && n == other.nonZeros() &&
         std::equal(one.valuePtr(), one.valuePtr() + n, other.valuePtr()) &&
         std::equal(one.innerIndexPtr(), one.innerIndexPtr() + n, other.innerIndexPtr()) &&
         std::equal(one.outerIndexPtr(), one.outerIndexPtr() + one.outerSize(), other.outerIndexPtr());
}

/// By which delta grows where K has no positive pivots: as much as a later one is smaller (iterated_penalty.cpp).
constexpr double larger_by = 64;

/// Whether the contact problem takes the sparse road (see ContactRoad).
bool takes_sparse(ContactRoad road, const FreeNumbering& numbering) {
  const auto all = static_cast<double>(numbering.unknown.size()), bounded = all - numbering.interior;
  if (bounded == 0 || road != ContactRoad::automatic) return bounded > 0 && road == ContactRoad::sparse;
  return bounded > 600 && bounded > 8 * std::sqrt(all);
}

}  // namespace

PenaltyFactor::PenaltyFactor(const VariationalInequality& problem, double delta, ContactRoad road,
                             std::unique_ptr<SparseCholesky> cholesky)
    : PenaltyFactor(Tied(problem), delta, road, std::move(cholesky)) {}

PenaltyFactor::PenaltyFactor(const Tied& problem, double delta, ContactRoad road,
                             std::unique_ptr<SparseCholesky> cholesky)
    : numbering_(*problem), a1_(problem->a1), b_(problem->b), m_(problem->m), first_delta_(delta) {
  if (takes_sparse(road, numbering_))
    held_.emplace(std::move(cholesky));
  else
    cholesky_ = std::move(cholesky);
  // beside a B' M B / delta above 1e14 A1 no digit of A1 is left: any larger delta gives the same answer
  for (int times = 0;; ++times) try {
      factorise(*problem, delta * std::pow(larger_by, times));
      return;
    } catch (const Error&) {
      if (times == 4 || problem->b.rows() == 0 || !std::isfinite(delta)) throw;
    }
}

PenaltyFactor::PenaltyFactor(const VariationalInequality& problem, double delta, ContactRoad road)
    : PenaltyFactor(checked(problem), delta, road, std::make_unique<DefaultCholesky>()) {}

PenaltyFactor::PenaltyFactor(const VariationalInequality& problem) : PenaltyFactor(moderate(problem, std::nullopt)) {}

PenaltyFactor PenaltyFactor::moderate(const VariationalInequality& problem, std::optional<double> penalty,
                                      ContactRoad road) {
  return moderate(problem, penalty, road, std::make_unique<DefaultCholesky>());
}

PenaltyFactor PenaltyFactor::moderate(const VariationalInequality& problem, std::optional<double> penalty,
                                      ContactRoad road, std::unique_ptr<SparseCholesky> cholesky) {
  return {problem, moderate_delta(checked(problem), penalty), road, std::move(cholesky)};
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
  SparseMatrix k = penalised_matrix(problem, numbering_, deltas_);
  std::optional<int> lost;
  Stopwatch watch;
  if (held_) {
    lost = held_->factorise(std::move(k));
    work_.analyse_seconds = held_->analyse_seconds();
    work_.factor_seconds = watch.lap() - work_.analyse_seconds;
  } else {
    if (!cholesky_->analysed()) {
      cholesky_->analyse(k, static_cast<int>(k.cols()) - numbering_.interior);
      work_.analyse_seconds = watch.lap();
    }
    lost = cholesky_->factorise(k);
  }
  if (lost)
    throw Error(fmt::format(
        "solve: A1 + B' M B / {:.3g} is not positive definite (at unknown {}): a part of the structure is held "
        "by nothing, a cell is too flat for double precision, or A1 and B are in units far apart; accepted: enough "
        "fixed unknowns, cells, entries of A1 and B' M B of like size",
        delta, numbering_.unknown[*lost]));
  if (!held_) {
    contact_block_ = cholesky_->trailing_block(numbering_.interior);
    work_.factor_seconds = watch.lap();
  }
  ++work_.factorisations;
}

double PenaltyFactor::smallest_pivot() const { return held_ ? held_->smallest_pivot() : cholesky_->smallest_pivot(); }

Eigen::VectorXd PenaltyFactor::forward(const Eigen::VectorXd& r) const {
  require_dense();
  return cholesky_->forward(r);
}

Eigen::VectorXd PenaltyFactor::backward(Eigen::VectorXd y) const {
  require_dense();
  return cholesky_->backward(std::move(y));
}

Eigen::VectorXd PenaltyFactor::solve(const Eigen::VectorXd& r) const {
  return held_ ? held_->solve(r) : cholesky_->backward(cholesky_->forward(r));
}

const Eigen::MatrixXd& PenaltyFactor::contact_block() const {
  require_dense();
  return contact_block_;
}

void PenaltyFactor::require_dense() const {
  if (held_)
    throw Error(
        fmt::format("solve: this factor of {} bounds among {} unknowns has no dense contact block; accepted: a factor "
                    "made with ContactRoad::dense",
                    numbering_.unknown.size() - numbering_.interior, numbering_.unknown.size()));
}

}  // namespace antilock
