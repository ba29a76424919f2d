#include "support/brute_force.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <vector>

namespace antilock::test {
namespace {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// Whether bound k can do what `state` says. An infinite bound does nothing, an equation always
/// holds or gives way.
bool there_is(int state, const LongVector& lower, const LongVector& upper, const LongVector& most,
              Eigen::Index k) {
  const bool equation = lower(k) == upper(k);
  if (state == 0 || state == 2) return !equation && (state == 0 || std::isfinite(upper(k)));
  if (state == 1) return std::isfinite(lower(k));
  return std::isfinite(most(k)) && std::isfinite(state == 3 ? lower(k) : upper(k));
}

/// The next state that there is for bound k, 5 after the last.
int next_state(int state, const LongVector& lower, const LongVector& upper, const LongVector& most,
               Eigen::Index k) {
  do ++state;
  while (state < 5 && !there_is(state, lower, upper, most, k));
  return state;
}

/// The next of all sets of states; false after the last.
bool next_set(std::vector<int>& set, const LongVector& lower, const LongVector& upper,
              const LongVector& most) {
  for (std::size_t i = 0; i < set.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    set[i] = next_state(set[i], lower, upper, most, k);
    if (set[i] < 5) return true;
    set[i] = next_state(-1, lower, upper, most, k);
  }
  return false;
}

}  // namespace

BruteForce brute_force(const VariationalInequality& problem) {
  std::vector<bool> fixed(problem.size(), false);
  for (const int i : problem.dirichlet_dofs) fixed[i] = true;
  std::vector<int> free;
  for (int i = 0; i < problem.size(); ++i)
    if (!fixed[i]) free.push_back(i);
  const LongMatrix b = Eigen::MatrixXd(problem.b).cast<long double>();
  const LongVector m = problem.m.cast<long double>();
  LongMatrix k = Eigen::MatrixXd(problem.a1).cast<long double>();
  LongVector u_fixed = LongVector::Zero(problem.size());
  for (std::size_t i = 0; i < problem.dirichlet_dofs.size(); ++i)
    u_fixed(problem.dirichlet_dofs[i]) = problem.dirichlet_values(static_cast<Eigen::Index>(i));
  const auto n = static_cast<Eigen::Index>(free.size());
  LongMatrix basis = LongMatrix::Identity(n, n);  // of the displacements allowed
  if (b.rows() > 0 && problem.compliance > 0)
    k += b.transpose() * m.asDiagonal() * b / static_cast<long double>(problem.compliance);
  if (b.rows() > 0 && problem.compliance == 0) {
    Eigen::FullPivLU<LongMatrix> lu(b(Eigen::indexing::all, free));
    lu.setThreshold(1e-12L);
    basis = lu.kernel();  // one column of zeros where the kernel is trivial
  }
  const LongVector force = (problem.load.cast<long double>() - k * u_fixed)(free);
  LongMatrix response = LongMatrix::Zero(n, n);  // displacement for each unit force
  if (!basis.isZero(0))
    response =
        basis *
        LongMatrix(basis.transpose() * k(free, free) * basis).ldlt().solve(basis.transpose());

  const int c = problem.bounds.count(), contact = static_cast<int>(problem.bounds.unknowns.size());
  LongMatrix rows = LongMatrix::Zero(c, problem.size());  // what is bounded
  for (int i = 0; i < contact; ++i) rows(i, problem.bounds.unknowns[i]) = 1;
  if (c > contact)
    rows.bottomRows(c - contact) = Eigen::MatrixXd(problem.bounds.constraints).cast<long double>();
  const LongMatrix on_free = rows(Eigen::indexing::all, free);
  const LongVector unloaded = rows * u_fixed + on_free * (response * force);
  const LongMatrix compliance = on_free * response * on_free.transpose();
  const LongVector lower = problem.bounds.lower.cast<long double>();
  const LongVector upper = problem.bounds.upper.cast<long double>();
  const LongVector most = problem.bounds.force_limit.cast<long double>();
  constexpr long double slack =
      1e-14L;  // of a sign: far above the round-off of 64-bit mantissas, far below any gap
  BruteForce best;
  // 0: free, 1: at the lower bound, 2: at the upper one, 3: below the lower one, 4: above the upper
  // one
  std::vector<int> set;
  set.reserve(c);
  for (int i = 0; i < c; ++i) set.push_back(next_state(-1, lower, upper, most, i));
  do {
    std::vector<int> held;
    LongVector bound = lower;
    for (int i = 0; i < c; ++i) {
      if (set[i] == 1 || set[i] == 2) held.push_back(i);
      if (set[i] == 2) bound(i) = upper(i);
    }
    LongVector lambda = LongVector::Zero(c);
    for (int i = 0; i < c; ++i)
      if (set[i] > 2) lambda(i) = set[i] == 3 ? most(i) : -most(i);
    if (!held.empty()) {
      const LongVector push = (bound - unloaded - compliance * lambda)(held);
      const LongVector reaction = LongMatrix(compliance(held, held)).ldlt().solve(push);
      lambda(held) = reaction;
    }
    const LongVector v = unloaded + compliance * lambda;
    bool right = lambda.allFinite();
    for (int i = 0; i < c; ++i) {
      const bool either = lower(i) == upper(i);  // an equation bears a force of either sign
      right = right &&
              (set[i] == 1 && !either ? lambda(i)
               : set[i] == 2          ? -lambda(i)
                                      : 0) >= -slack &&
              most(i) - std::abs(lambda(i)) >= -slack;
      right =
          right &&
          (set[i] == 3 ? lower(i) - v(i) : v(i) - (set[i] == 4 ? upper(i) : lower(i))) >= -slack &&
          (set[i] > 2 || upper(i) - v(i) >= -slack);
    }
    if (!right) continue;
    ++best.answers;
    const LongVector x = response * (force + on_free.transpose() * lambda);
    best.u = u_fixed.cast<double>();
    for (Eigen::Index i = 0; i < n; ++i) best.u(free[i]) = static_cast<double>(x(i));
    best.lambda = lambda.cast<double>();
    best.active.assign(c, false);
    for (const int i : held) best.active[i] = true;
  } while (next_set(set, lower, upper, most));
  EXPECT_EQ(best.answers, 1) << "contact sets that satisfy every condition";
  return best;
}  // namespace

}  // namespace antilock::test
