#include "antilock/solve/detail/sparse_contact.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "antilock/core/error.hpp"
#include "antilock/solve/detail/tuned.hpp"

namespace antilock {
namespace {

/// One level of smoothed aggregation of a symmetric K (n x n), by its entries alone.
struct Aggregates {
  std::vector<int> of;        ///< n: the aggregate of each unknown
  SparseMatrix prolongation;  ///< n x n_c: P = (I - 2/3 D^-1 K) P0, P0 = 1 on the members of an aggregate
  SparseMatrix coarse;        ///< n_c x n_c, the upper triangle of P' K P
};

/// Calls `visit` with each neighbour of unknown i in K, by columns.
template <class Visit>
void for_neighbours(const SparseMatrix& k, const Eigen::VectorXd& diagonal, int i, const Visit& visit) {
  for (SparseMatrix::InnerIterator it(k, i); it; ++it)
    if (it.row() != i && std::abs(it.value()) > 0.08 * std::sqrt(diagonal(i) * diagonal(it.row())))
      visit(static_cast<int>(it.row()));
}

std::vector<int> aggregates_of(const SparseMatrix& k, const Eigen::VectorXd& diagonal, int& count) {
  const int size = static_cast<int>(k.cols());
  std::vector<int> of(size, -1);
  for (int i = 0; i < size; ++i) {
    bool alone = of[i] < 0;
    for_neighbours(k, diagonal, i, [&](int j) { alone = alone && of[j] < 0; });
    if (!alone) continue;
    of[i] = count;
    for_neighbours(k, diagonal, i, [&](int j) { of[j] = count; });
    ++count;
  }
  const std::vector<int> first = of;
  for (int i = 0; i < size; ++i)
    if (first[i] < 0)
      for_neighbours(k, diagonal, i, [&](int j) {
        if (of[i] < 0) of[i] = first[j];
      });
  for (int& aggregate : of)
    if (aggregate < 0) aggregate = count++;
  return of;
}

/// Unknowns are neighbours where |k_ij| > 0.08 sqrt(k_ii k_jj). An unknown none of whose neighbours has an aggregate makes
/// one with all of them; the others join that of a neighbour. P. Vanek, J. Mandel, M. Brezina, Computing 56 (1996): 0.08 is
/// theirs, and the weight 2/3 is their 4/3 over the largest eigenvalue of D^-1 K, about 2 for first derivatives.
/// `upper`: the upper triangle of K.
Aggregates smoothed_aggregation(const SparseMatrix& upper) {
  const SparseMatrix k = upper.selfadjointView<Eigen::Upper>();
  const Eigen::VectorXd diagonal = k.diagonal();
  int count = 0;
  Aggregates aggregates{aggregates_of(k, diagonal, count), {}, {}};
  SparseMatrix p0(k.cols(), count);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(k.cols());
  for (int i = 0; i < k.cols(); ++i) entries.emplace_back(i, aggregates.of[i], 1.0);
  p0.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd weight = (2.0 / 3) * diagonal.cwiseInverse();
  const SparseMatrix kp0 = k * p0;
  aggregates.prolongation = p0 - SparseMatrix(weight.asDiagonal() * kp0);
  const SparseMatrix kp = k * aggregates.prolongation;
  const SparseMatrix coarse = aggregates.prolongation.transpose() * kp;
  aggregates.coarse = coarse.triangularView<Eigen::Upper>();
  return aggregates;
}

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

/// Whether a constant costs no energy but near what is fixed, as aggregation supposes: rows of K sum to 0, to round-off.
/// Beside what is fixed they do not; of a mesh that is a part of all rows that falls like h. In a beam or a plate the rows
/// of the rotations do not, half of all or more. A quarter tells the two apart.
bool constants_are_free(const HeldFactor& k) {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(k.upper().cols());
  return 4 * (k.times(one).array().abs() > tuned::round_off * k.absolute_times(one).array()).count() < one.size();
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
  Equilibrium now{std::move(x), given, noise(bounded())};
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i] != 0) now.lambda(static_cast<Eigen::Index>(i)) = force(bounded()[i]);
  return now;
}

Pieces SparseContact::nested_start(const Stairs& stairs, int max_steps) {
  Pieces start(bounded().size(), Piece::between);
  if (bounded().size() <= 1) return start;
  Aggregates aggregates;
  if (constants_are_free(k_)) aggregates = smoothed_aggregation(k_.upper());
  const SparseMatrix& p = aggregates.prolongation;
  if (p.cols() == 0 || 2 * p.cols() > p.rows()) {  // half of all at most: no start costs more than the finest problem
    std::vector<int> second;
    for (std::size_t i = 1; i < bounded().size(); i += 2) second.push_back(bounded()[i]);
    SparseContact coarse(k_, q_, second);
    return start_by_halves(stairs, coarse, max_steps);
  }

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
