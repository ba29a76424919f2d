// The naive way fails as the tutorial says, and no wrong answer of it gets past the checks.
#include "antilock/solve/summed.hpp"
#include "support/scenes.hpp"

namespace antilock::test::naive_test {

struct Setting {
  TriangleMesh mesh;
  const Element* element;
};
std::vector<Setting> settings() {
  return {{structured_mesh(16), &p1()},
          {structured_mesh(16), &crouzeix_raviart()},
          {unstructured_mesh(16), &crouzeix_raviart()}};
}

// The sum A1 + epsilon^-2 A0 rounds A1 by eps / epsilon^2, and so the equations hold to a small
// multiple of that: measured with seven kernels of OpenBLAS up to 4.6 eps / epsilon^2; the bound is
// 14 times that. Below 1e-8 nothing is left. An answer off by more than 1e-6 carries at least a
// warning, one off by more than 1e-3 is refused.
TEST(Naive, IsRightWhereEpsilonIsModerateAndNoWrongAnswerGetsPastTheChecks) {
  int wrong = 0, silent = 0;
  for (const Setting& s : settings()) {
    const Space space(s.mesh, *s.element);
    for (int exponent = 0; exponent <= 16; ++exponent) {
      const VariationalInequality problem = test::stiff_problem(space, std::pow(10.0, -exponent));
      const double rounded = std::numeric_limits<double>::epsilon() / problem.compliance;
      const Eigen::VectorXd right = active_set(problem).u;
      for (const SummedFactor kind : {SummedFactor::cholesky, SummedFactor::lu}) {
        NaiveResult answer = naive_summed_solve(problem, kind);
        const double off = test::relative_difference(answer.solution.u, right);
        SCOPED_TRACE(answer.solution.solver + " at 1e-" + std::to_string(exponent) + ", off by " +
                     std::to_string(off));
        if (exponent <= 2) {
          EXPECT_EQ(answer.reason, ConvergedReason::converged);
          EXPECT_LT(off, 1e-9);  // rounded: 2e-12 at 1e-2
          EXPECT_LT(worst_violation(answer.solution.kkt), 64 * rounded);
        }
        if (exponent > 8) {
          EXPECT_GT(off, 0.1);
          silent += answer.reason == ConvergedReason::converged;
        }
        if (off > 1e-3) {
          ++wrong;
          EXPECT_THROW(check_kkt(problem, answer.solution), NotConverged);
        } else if (off > 1e-6) {
          try {
            check_kkt(problem, answer.solution);
            EXPECT_FALSE(answer.solution.warning.empty());
          } catch (const NotConverged&) {  // refused: safer still
          }
        }
      }
    }
  }
  EXPECT_GE(wrong, 30) << "the exhibit must contain wrong answers, else this test tests nothing";
  EXPECT_GE(silent, 1) << "garbage that looks like success is the point of the exhibit";
}

TEST(Naive, HasNoSumAtEpsilonZeroAndStopsAtItsCap) {
  const Space space(structured_mesh(4), p1());
  EXPECT_THROW(naive_summed_solve(test::stiff_problem(space, 0), SummedFactor::lu), Error);
  VariationalInequality with_a_fixed_row = test::stiff_problem(space, 1);
  with_a_fixed_row.fixed_compliances =
      Eigen::VectorXd::Constant(1, 1e-3);  // of the last row, which would get 1
  expect_refused([&] { naive_summed_solve(with_a_fixed_row, SummedFactor::lu); },
                 "fixed compliances");
  const NaiveResult answer =
      naive_summed_solve(test::stiff_problem(space, 1), SummedFactor::cholesky, 1);
  EXPECT_EQ(answer.reason, ConvergedReason::max_iterations);
  EXPECT_EQ(to_string(answer.reason), "step cap");
  EXPECT_EQ(to_string(ConvergedReason::converged) + to_string(ConvergedReason::cycled) +
                to_string(ConvergedReason::linear_solve_failed),
            "settledcycledrefused");
}

}  // namespace antilock::test::naive_test
