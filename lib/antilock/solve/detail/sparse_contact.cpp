#include "antilock/solve/detail/sparse_contact.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/solve/detail/aggregation.hpp"
#include "antilock/solve/detail/tuned.hpp"

namespace antilock {
namespace {

/// Of the members of each coarse bound: their sum, or their mean. Infinite where one of them is.
Eigen::VectorXd sums(const Eigen::VectorXd& of_fine, const std::vector<int>& coarse_of, Eigen::Index coarse,
                     bool mean) {
  if (of_fine.size() == 0) return {};
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(coarse), members = sum;
  for (Eigen::Index i = 0; i < of_fine.size(); ++i) {
    sum(coarse_of[i]) += of_fine(i);
    ++members(coarse_of[i]);
  }
  return mean ? Eigen::VectorXd(sum.cwiseQuotient(members)) : sum;
}

/// Whether a constant costs no energy but near what is fixed, as aggregation supposes: where a third of the rows of K or
/// more do not sum to 0, half of the digits apart, it does (in a beam the rotations, half of all unknowns).
bool constants_are_free(const SparseMatrix& upper) {
  const Eigen::VectorXd sums = upper.selfadjointView<Eigen::Upper>() * Eigen::VectorXd::Ones(upper.cols());
  const double half_the_digits = std::sqrt(std::numeric_limits<double>::epsilon());
  return 3 * (sums.array().abs() > half_the_digits * upper.diagonal().array()).count() < upper.cols();
}

}  // namespace

Equilibrium SparseContact::solve(const std::vector<char>& held, const Eigen::VectorXd& given) {
  std::vector<char> held_places(q_.size(), 0);
  Eigen::VectorXd q = q_, x = Eigen::VectorXd::Zero(q_.size());
  for (std::size_t i = 0; i < held.size(); ++i) {
    held_places[bounded()[i]] = held[i];
    (held[i] != 0 ? x : q)(bounded()[i]) += given(static_cast<Eigen::Index>(i));
  }
  k_.hold(held_places);
  x += k_.solve(q - k_.times(x));
  const Eigen::VectorXd force = k_.times(x) - q_;
  const Eigen::VectorXd noise = tuned::round_off * (k_.absolute_times(x.cwiseAbs()) + q_.cwiseAbs());
  Eigen::VectorXd pushed = Eigen::VectorXd::Zero(q_.size());
  pushed(bounded()) = noise(bounded());
  const Eigen::VectorXd moved = k_.solve(pushed).cwiseAbs();
  Equilibrium now{std::move(x), given, moved(bounded())};
  for (std::size_t i = 0; i < held.size(); ++i)
    if (const auto k = static_cast<Eigen::Index>(i); held[i] != 0) {
      now.lambda(k) = force(bounded()[i]);
      now.round_off(k) = noise(bounded()[i]);
    }
  return now;
}

Pieces SparseContact::nested_start(const Stairs& stairs, int max_steps) {
  Pieces start(bounded().size(), Piece::between);
  if (bounded().size() <= 8) return start;
  if (!constants_are_free(k_.upper())) {
    std::vector<int> second;
    for (std::size_t i = 1; i < bounded().size(); i += 2) second.push_back(bounded()[i]);
    SparseContact coarse(k_, q_, second);
    return start_by_halves(stairs, coarse, max_steps);
  }
  Aggregates aggregates = smoothed_aggregation(k_.upper());
  const SparseMatrix& p = aggregates.prolongation;
  if (3 * p.cols() > 2 * p.rows()) return start;  // nothing to aggregate

  std::vector<int> aggregated, bound_of(p.cols(), -1), coarse_of;  // aggregate -> its bound, bound -> coarse bound
  for (const int place : bounded()) {
    int& bound = bound_of[aggregates.of[place]];
    if (bound < 0) {
      bound = static_cast<int>(aggregated.size());
      aggregated.push_back(aggregates.of[place]);
    }
    coarse_of.push_back(bound);
  }
  const auto count = static_cast<Eigen::Index>(aggregated.size());
  const Stairs fewer{sums(stairs.lower, coarse_of, count, true), sums(stairs.upper, coarse_of, count, true),
                     sums(stairs.bears, coarse_of, count, false), sums(stairs.force, coarse_of, count, false)};
  const Eigen::VectorXd q = p.transpose() * q_;
  HeldFactor k;
  Pieces pieces;
  try {
    if (k.factorise(std::move(aggregates.coarse))) return start;
    SparseContact coarse(k, q, std::move(aggregated));
    pieces = solve_contact(coarse, fewer, std::nullopt, max_steps).pieces;
  } catch (const Error&) {
    return start;  // a start, no more: the fine problem says what is wrong
  }
  const RowMatrix rows = p;
  for (std::size_t i = 0; i < bounded().size(); ++i) {
    start[i] = pieces[coarse_of[i]];
    for (RowMatrix::InnerIterator w(rows, bounded()[i]); w; ++w)
      start[i] = agreed(start[i], bound_of[w.col()] >= 0 ? pieces[bound_of[w.col()]] : Piece::between);
  }
  return start;
}

}  // namespace antilock
