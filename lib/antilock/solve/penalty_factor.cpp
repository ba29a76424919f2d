#include "antilock/solve/penalty_factor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/solve/default_cholesky.hpp"

namespace antilock {
namespace {

const VariationalInequality& checked(const VariationalInequality& problem) {
  check(problem);
  return problem;
}

/// Of the bits of A1, B and M (FNV-1a, an entry at a time): equal for equal matrices, and for no others in practice. Four
/// hashes side by side, each of every fourth entry: a multiplication need not wait for the one before.
std::uint64_t fingerprint(const VariationalInequality& problem) {
  std::array<std::uint64_t, 4> hash;
  hash.fill(0xcbf29ce484222325);
  const auto add = [](std::uint64_t& lane, std::uint64_t bits) { lane = (lane ^ bits) * 0x100000001b3; };
  const auto add_all = [&](const auto* entries, Eigen::Index count, const auto& bits) {
    Eigen::Index i = 0;
    for (; i + 4 <= count; i += 4)
      for (int lane = 0; lane < 4; ++lane) add(hash[lane], bits(entries[i + lane]));
    for (; i < count; ++i) add(hash[0], bits(entries[i]));
    add(hash[0], static_cast<std::uint64_t>(count));
  };
  const auto of_value = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  const auto of_place = [](int place) { return static_cast<std::uint64_t>(place); };
  add_all(problem.a1.valuePtr(), problem.a1.nonZeros(), of_value);
  add_all(problem.b.valuePtr(), problem.b.nonZeros(), of_value);
  add_all(problem.m.data(), problem.m.size(), of_value);
  add_all(problem.a1.innerIndexPtr(), problem.a1.nonZeros(), of_place);
  add_all(problem.b.innerIndexPtr(), problem.b.nonZeros(), of_place);
  for (int lane = 1; lane < 4; ++lane) add(hash[0], hash[lane]);
  return hash[0];
}

/// Whether the contact problem takes the sparse road (see ContactRoad).
bool takes_sparse(ContactRoad road, const FreeNumbering& numbering) {
  const auto all = static_cast<double>(numbering.unknown.size()), bounded = all - numbering.interior;
  if (bounded == 0 || road != ContactRoad::automatic) return bounded > 0 && road == ContactRoad::sparse;
  return bounded > 600 && bounded > 8 * std::sqrt(all);
}

}  // namespace

PenaltyFactor::PenaltyFactor(const VariationalInequality& problem, double delta, ContactRoad road,
                             std::unique_ptr<SparseCholesky> cholesky)
    : numbering_(problem), matrices_(fingerprint(problem)) {
  if (takes_sparse(road, numbering_))
    held_.emplace(std::move(cholesky));
  else
    cholesky_ = std::move(cholesky);
  factorise(problem, delta);
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
  check_unknowns(problem);
  if (fingerprint(problem) != matrices_)
    throw Error("solve: the factor is of another A1, B or M; accepted: the factor of this problem's matrices");
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

void PenaltyFactor::refactor(const VariationalInequality& problem, double delta) {
  const std::uint64_t matrices = fingerprint(problem);
  if (matrices != matrices_) {
    check(problem);
    matrices_ = matrices;
  }
  check_unknowns(problem);
  factorise(problem, delta);
}

void PenaltyFactor::factorise(const VariationalInequality& problem, double delta) {
  if (!(delta > 0 && std::isfinite(delta)))
    throw Error(fmt::format("solve: delta = {}; accepted: a positive number", delta));
  delta_ = delta;
  SparseMatrix k = penalised_matrix(problem, numbering_, delta);
  std::optional<int> lost;
  Stopwatch watch;
  if (held_) {
    lost = held_->factorise(std::move(k));
    analyse_seconds = held_->analyse_seconds;
    factor_seconds = watch.lap() - analyse_seconds;
  } else {
    if (!cholesky_->analysed()) {
      cholesky_->analyse(k, static_cast<int>(k.cols()) - numbering_.interior);
      analyse_seconds = watch.lap();
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
    factor_seconds = watch.lap();
  }
  ++factorisations;
}

double PenaltyFactor::smallest_pivot() const { return held_ ? held_->smallest_pivot() : cholesky_->smallest_pivot(); }

Eigen::VectorXd PenaltyFactor::forward(const Eigen::VectorXd& r) const {
  require_dense();
  return cholesky_->forward(r);
}

Eigen::VectorXd PenaltyFactor::backward(Eigen::VectorXd y) {
  require_dense();
  ++solves;
  return cholesky_->backward(std::move(y));
}

Eigen::VectorXd PenaltyFactor::solve(const Eigen::VectorXd& r) {
  ++solves;
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
