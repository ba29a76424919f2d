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

/// The next of all sets of bounds that hold; false after the last. An infinite bound holds nowhere.
bool next_set(std::vector<int>& set, const LongVector& lower, const LongVector& upper) {
  for (std::size_t i = 0; i < set.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    do ++set[i];
    while ((set[i] == 1 && std::isinf(lower(k))) || (set[i] == 2 && std::isinf(upper(k))));
    if (set[i] < 3) return true;
    set[i] = 0;
  }
  return false;
}

}  // namespace

BruteForce brute_force(const VariationalInequality& problem) {
  std::vector<bool> fixed(problem.size(), false);
  for (const int i : problem.fixed) fixed[i] = true;
  std::vector<int> free;
  for (int i = 0; i < problem.size(); ++i)
    if (!fixed[i]) free.push_back(i);
  const LongMatrix b = Eigen::MatrixXd(problem.b).cast<long double>();
  const LongVector m = problem.m.cast<long double>();
  LongMatrix k = Eigen::MatrixXd(problem.a1).cast<long double>();
  LongVector u_fixed = LongVector::Zero(problem.size());
  for (std::size_t i = 0; i < problem.fixed.size(); ++i)
    u_fixed(problem.fixed[i]) = problem.fixed_values(static_cast<Eigen::Index>(i));
  const auto n = static_cast<Eigen::Index>(free.size());
  LongMatrix basis = LongMatrix::Identity(n, n);  // of the displacements allowed
  if (b.rows() > 0 && problem.compliance > 0)
    k += b.transpose() * m.asDiagonal() * b / static_cast<long double>(problem.compliance);
  if (b.rows() > 0 && problem.compliance == 0) {
    Eigen::FullPivLU<LongMatrix> lu(b(Eigen::all, free));
    lu.setThreshold(1e-12L);
    basis = lu.kernel();  // one column of zeros where the kernel is trivial
  }
  const LongVector force = (problem.load.cast<long double>() - k * u_fixed)(free);
  LongMatrix response = LongMatrix::Zero(n, n);  // displacement for each unit force
  if (!basis.isZero(0))
    response = basis * LongMatrix(basis.transpose() * k(free, free) * basis).ldlt().solve(basis.transpose());

  const int c = problem.bound_count(), contact = static_cast<int>(problem.contact.size());
  LongMatrix rows = LongMatrix::Zero(c, problem.size());  // what is bounded
  for (int i = 0; i < contact; ++i) rows(i, problem.contact[i]) = 1;
  if (c > contact) rows.bottomRows(c - contact) = Eigen::MatrixXd(problem.combinations).cast<long double>();
  const LongMatrix on_free = rows(Eigen::all, free);
  const LongVector unloaded = rows * u_fixed + on_free * (response * force);
  const LongMatrix compliance = on_free * response * on_free.transpose();
  const LongVector lower = problem.lower.cast<long double>();
  const LongVector upper = problem.upper.size() > 0
                               ? LongVector(problem.upper.cast<long double>())
                               : LongVector(LongVector::Constant(c, std::numeric_limits<long double>::infinity()));
  constexpr long double slack = 1e-14L;  // of a sign: far above the round-off of 64-bit mantissas, far below any gap
  BruteForce best;
  // 0: free, 1: at the lower bound, 2: at the upper one
  std::vector<int> set(c, 0);
  do {
    std::vector<int> held;
    LongVector bound = lower;
    for (int i = 0; i < c; ++i) {
      if (set[i] != 0) held.push_back(i);
      if (set[i] == 2) bound(i) = upper(i);
    }
    LongVector lambda = LongVector::Zero(c);
    if (!held.empty()) {
      const LongVector push = (bound - unloaded)(held);
      const LongVector reaction = LongMatrix(compliance(held, held)).ldlt().solve(push);
      lambda(held) = reaction;
    }
    const LongVector v = unloaded + compliance * lambda;
    bool right = lambda.allFinite();
    for (int i = 0; i < c; ++i)
      right = right && (set[i] == 2 ? -lambda(i) : lambda(i)) >= -slack && v(i) - lower(i) >= -slack &&
              upper(i) - v(i) >= -slack;
    if (!right) continue;
    ++best.answers;
    const LongVector x = response * (force + on_free.transpose() * lambda);
    best.u = u_fixed.cast<double>();
    for (Eigen::Index i = 0; i < n; ++i) best.u(free[i]) = static_cast<double>(x(i));
    best.lambda = lambda.cast<double>();
    best.active.assign(c, false);
    for (const int i : held) best.active[i] = true;
  } while (next_set(set, lower, upper));
  EXPECT_EQ(best.answers, 1) << "contact sets that satisfy every condition";
  return best;
}  // namespace

}  // namespace antilock::test
