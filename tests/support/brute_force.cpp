#include "support/brute_force.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace antilock::test {
namespace {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

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

  const auto c = static_cast<Eigen::Index>(problem.contact.size());
  std::vector<int> place(problem.size(), -1), at;
  for (Eigen::Index i = 0; i < n; ++i) place[free[i]] = static_cast<int>(i);
  for (const int i : problem.contact) at.push_back(place[i]);
  const LongVector unloaded = response * force;
  const LongMatrix compliance = response(at, at);
  const LongVector lower = problem.lower.cast<long double>();
  constexpr long double slack = 1e-14L;  // of a sign: far above the round-off of 64-bit mantissas, far below any gap
  BruteForce best;
  for (unsigned set = 0; set < (1U << c); ++set) {
    std::vector<int> held;
    for (int i = 0; i < c; ++i)
      if ((set >> i) & 1U) held.push_back(i);
    LongVector lambda = LongVector::Zero(c);
    if (!held.empty()) {
      const LongVector push = (lower - unloaded(at))(held);
      const LongVector reaction = LongMatrix(compliance(held, held)).ldlt().solve(push);
      lambda(held) = reaction;
    }
    const LongVector v = unloaded(at) + compliance * lambda;
    if (lambda.size() > 0 && (lambda.minCoeff() < -slack || (v - lower).minCoeff() < -slack || !lambda.allFinite()))
      continue;
    ++best.answers;
    LongVector total = force;
    for (Eigen::Index i = 0; i < c; ++i) total(at[i]) += lambda(i);
    const LongVector x = response * total;
    best.u = u_fixed.cast<double>();
    for (Eigen::Index i = 0; i < n; ++i) best.u(free[i]) = static_cast<double>(x(i));
    best.lambda = lambda.cast<double>();
    best.active.assign(c, false);
    for (const int i : held) best.active[i] = true;
  }
  EXPECT_EQ(best.answers, 1) << "contact sets that satisfy every condition";
  return best;
}

}  // namespace antilock::test
