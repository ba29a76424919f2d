#include "antilock/solve/contact_systems.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "antilock/core/dense.hpp"
#include "antilock/core/error.hpp"
#include "antilock/solve/defaults.hpp"

namespace antilock {
namespace {

Cholesky factor_of(const Eigen::MatrixXd& s) {
  Cholesky factor(s);
  if (!factor.positive_definite())
    throw Error("contact: the Schur complement is not positive definite");
  return factor;
}

std::vector<int> from_zero_to(Eigen::Index count) {
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// Unknown -> group, by the entries of a symmetric K alone. Neighbours are strongly connected
/// where |k_ij| > 0.08 sqrt(k_ii k_jj). An unknown none of whose neighbours has a group makes one
/// with all of them; the others join that of a neighbour. P. Vanek, J. Mandel, M. Brezina,
/// Computing 56 (1996): 0.08 is theirs.
std::vector<int> groups_of(const SparseMatrix& k) {
  const int size = static_cast<int>(k.cols());
  const Eigen::VectorXd root = k.diagonal().cwiseSqrt();
  const auto neighbours = [&](int i) {  // and i itself
    std::vector<int> near;
    for (SparseMatrix::InnerIterator it(k, i); it; ++it)
      if (std::abs(it.value()) > 0.08 * root(i) * root(it.row()))
        near.push_back(static_cast<int>(it.row()));
    return near;
  };
  std::vector<int> group(size, -1);
  int count = 0;
  for (int i = 0; i < size; ++i) {
    const std::vector<int> near = neighbours(i);
    if (std::any_of(near.begin(), near.end(), [&](int j) { return group[j] >= 0; })) continue;
    for (const int j : near) group[j] = count;
    ++count;
  }
  const std::vector<int> first = group;
  for (int i = 0; i < size; ++i) {
    if (first[i] >= 0) continue;
    for (const int j : neighbours(i)) group[i] = std::max(group[i], first[j]);
    if (group[i] < 0) group[i] = count++;
  }
  return group;
}

/// Whether a constant costs no energy but near what is fixed, as aggregation supposes: rows of K
/// sum to 0, to round-off. Beside what is fixed they do not; of a mesh that is a part of all rows
/// that falls like h. In a beam or a plate the rows of the rotations do not, half of all or more. A
/// quarter tells the two apart.
bool constants_are_free(const ConstrainedCholesky& k) {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(k.upper_triangle().cols());
  return 4 * (k.times(one).array().abs() > defaults::round_off * k.absolute_times(one).array())
                 .count() <
         one.size();
}

/// The bounds of the sums over groups of unknowns: the means of the finite limits, and the sums of
/// the forces. `members` (unknowns x groups) is 1 at the group of each unknown, and `bounded` has
/// the unknown of each bound.
ShiftedBounds aggregated(const ShiftedBounds& bounds, const RowMatrix& members,
                         const std::vector<int>& bounded) {
  const auto sum = [&](const Eigen::VectorXd& of_bounds) {
    Eigen::VectorXd of_unknowns = Eigen::VectorXd::Zero(members.rows());
    of_unknowns(bounded) = of_bounds;
    return Eigen::VectorXd(members.transpose() * of_unknowns);
  };
  const auto mean = [&](const Eigen::VectorXd& limits, double none) {
    const auto finite = limits.array().isFinite();
    const Eigen::ArrayXd count = sum(finite.cast<double>());
    const Eigen::ArrayXd total = sum(finite.select(limits.array(), 0));
    return Eigen::VectorXd((count > 0).select(total / count, none));
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {BoundLimits(mean(bounds.lower, -infinity), mean(bounds.upper, infinity),
                      sum(bounds.force_limit)),
          sum(bounds.multiplier_estimate)};
}

/// The prolongation P = (I - 2/3 D^-1 K) P0 of smoothed aggregation, P0 = `members`. The weight is
/// Vanek's 4/3 over the largest eigenvalue of D^-1 K, which is about 2 for first derivatives.
SparseMatrix smoothed_aggregation(const SparseMatrix& k, const RowMatrix& members) {
  const Eigen::VectorXd weight = (2.0 / 3) * k.diagonal().cwiseInverse();
  return SparseMatrix(members) - SparseMatrix(weight.asDiagonal() * SparseMatrix(k * members));
}

}  // namespace

SchurComplementContact::SchurComplementContact(const Eigen::MatrixXd& s, const Eigen::VectorXd& q)
    : ContactSystem(from_zero_to(q.size())), s_(s), q_(q) {}

FixedStatusSolution SchurComplementContact::solve(const std::vector<char>& active,
                                                  const Eigen::VectorXd& prescribed) {
  std::vector<int> free, fixed;
  for (int i = 0; i < static_cast<int>(active.size()); ++i)
    (active[i] != 0 ? fixed : free).push_back(i);
  FixedStatusSolution now{prescribed, prescribed, {}};
  if (!free.empty()) {
    Eigen::VectorXd rhs = q_(free) + prescribed(free);
    if (!fixed.empty()) rhs.noalias() -= s_(free, fixed) * prescribed(fixed);
    const Eigen::VectorXd v = factor_of(s_(free, free)).solve(rhs);
    now.v(free) = v;
  }
  if (!fixed.empty()) now.lambda(fixed) = s_(fixed, Eigen::indexing::all) * now.v - q_(fixed);
  // each force by the terms of its own row: one stiff unknown must not hide the pull on a soft one
  now.round_off = defaults::round_off * (s_.cwiseAbs() * now.v.cwiseAbs() + q_.cwiseAbs());
  return now;
}

BoundStatuses SchurComplementContact::nested_start(const ShiftedBounds& bounds,
                                                   int max_iterations) {
  const int fine = bounds.count(), coarse = fine / 2;
  if (fine <= 1) return BoundStatuses(fine, BoundStatus::inactive);
  const auto bounded = Eigen::seqN(1, coarse, 2), others = Eigen::seqN(0, fine - coarse, 2);
  const Cholesky factor = factor_of(s_(others, others));
  const Eigen::MatrixXd half = factor.forward(Eigen::MatrixXd(s_(others, bounded)));
  const Eigen::VectorXd half_q = factor.forward(Eigen::VectorXd(q_(others)));
  const Eigen::MatrixXd s = Eigen::MatrixXd(s_(bounded, bounded)) - half.transpose() * half;
  const Eigen::VectorXd q = Eigen::VectorXd(q_(bounded)) - half.transpose() * half_q;
  SchurComplementContact smaller(s, q);
  return coarse_start(bounds, smaller, max_iterations);
}

FixedStatusSolution SparseContact::solve(const std::vector<char>& active,
                                         const Eigen::VectorXd& prescribed) {
  std::vector<char> constrained(q_.size(), 0);
  Eigen::VectorXd q = q_, x = Eigen::VectorXd::Zero(q_.size());
  for (std::size_t i = 0; i < active.size(); ++i) {
    constrained[bounded()[i]] = active[i];
    (active[i] != 0 ? x : q)(bounded()[i]) += prescribed(static_cast<Eigen::Index>(i));
  }
  k_.constrain(constrained);
  x += k_.solve(q - k_.times(x));
  const Eigen::VectorXd force = k_.times(x) - q_;
  const Eigen::VectorXd noise =
      defaults::round_off * (k_.absolute_times(x.cwiseAbs()) + q_.cwiseAbs());
  FixedStatusSolution now{std::move(x), prescribed, noise(bounded())};
  for (std::size_t i = 0; i < active.size(); ++i)
    if (active[i] != 0) now.lambda(static_cast<Eigen::Index>(i)) = force(bounded()[i]);
  return now;
}

BoundStatuses SparseContact::nested_start(const ShiftedBounds& bounds, int max_iterations) {
  BoundStatuses start(bounded().size(), BoundStatus::inactive);
  if (bounded().size() <= 1) return start;
  const SparseMatrix whole = k_.upper_triangle().selfadjointView<Eigen::Upper>();
  const std::vector<int> group =
      constants_are_free(k_) ? groups_of(whole) : from_zero_to(q_.size());
  const int groups = 1 + *std::max_element(group.begin(), group.end());
  if (2 * groups > q_.size()) {  // half of all at most: no start costs more than the finest problem
    std::vector<int> second;
    for (std::size_t i = 1; i < bounded().size(); i += 2) second.push_back(bounded()[i]);
    SparseContact coarse(k_, q_, second);
    return coarse_start(bounds, coarse, max_iterations);
  }

  RowMatrix members(q_.size(), groups);
  for (Eigen::Index i = 0; i < q_.size(); ++i) members.insert(i, group[i]) = 1;
  const SparseMatrix p = smoothed_aggregation(whole, members);
  const Eigen::VectorXd q = p.transpose() * q_;
  try {
    ConstrainedCholesky k;
    if (k.factorise(
            SparseMatrix(p.transpose() * SparseMatrix(whole * p)).triangularView<Eigen::Upper>()))
      return start;
    SparseContact coarse(k, q, from_zero_to(groups));
    const ShiftedBounds of_groups = aggregated(bounds, members, bounded());
    const BoundStatuses status =
        solve_contact(coarse, of_groups, std::nullopt, max_iterations).status;
    const RowMatrix rows = p;
    for (std::size_t i = 0; i < bounded().size(); ++i) {
      start[i] = status[group[bounded()[i]]];
      for (RowMatrix::InnerIterator w(rows, bounded()[i]); w; ++w)
        start[i] = common_status(start[i], status[w.col()]);
    }
  } catch (const Error&) {  // a start, no more: the fine problem says what is wrong
  }
  return bounds.nearest_valid(std::move(start));
}

}  // namespace antilock
