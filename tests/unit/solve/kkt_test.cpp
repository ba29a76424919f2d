// The report that stands between a solver and its caller: relative, scale-free, and merciless.
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/residual.hpp"
#include "support/scenes.hpp"
#include "support/small_problem.hpp"

namespace antilock::test::solve_test::kkt_test {

/// A solved problem of Figure 5 on a small mesh, with contact on part of Gamma_C.
struct Solved {
  explicit Solved(double epsilon)
      : space(unstructured_mesh(8), crouzeix_raviart()),
        problem(stiff_problem(space, epsilon, {[](double) { return 1e-4; }})),
        solution(active_set(problem)) {}
  Space space;
  VariationalInequality problem;
  Solution solution;
};

int held(const Solution& s) {
  return static_cast<int>(std::find(s.active.begin(), s.active.end(), true) - s.active.begin());
}
int loose(const Solution& s) {
  return static_cast<int>(std::find(s.active.begin(), s.active.end(), false) - s.active.begin());
}

TEST(Kkt, SplitResidualIsZeroOfTheSolutionAndTheReactionOnTheClamps) {
  const Solved s(1e-3);
  const SplitResidual r = exact_residual(s.problem, s.solution.u, s.solution.p, s.solution.lambda);
  Eigen::VectorXd free = r.r1;
  free(s.problem.dirichlet_dofs).setZero();
  EXPECT_LT(free.cwiseAbs().maxCoeff(), 1e-9 * s.problem.load.cwiseAbs().maxCoeff() * 100);
  EXPECT_GT(Eigen::VectorXd(r.r1(s.problem.dirichlet_dofs)).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT(r.r2.cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Kkt, APullIsMeasuredByTheLargestForce) {
  const Solved s(0.1);
  Solution wrong = s.solution;
  const double largest =
      std::max(s.problem.load.cwiseAbs().maxCoeff(), s.solution.lambda.cwiseAbs().maxCoeff());
  wrong.lambda(held(s.solution)) = -0.1 * largest;
  EXPECT_NEAR(kkt_report(s.problem, wrong).min_pressure, -0.1, 1e-12);
}

// A string between two clamps, pulled by nothing else: what its middle is out of balance counts in
// units of the reaction.
TEST(Kkt, AResidualIsMeasuredByTheReactionWhereNoLoadActs) {
  VariationalInequality problem =
      small_problem(Eigen::Matrix3d{{1, -1, 0}, {-1, 2, -1}, {0, -1, 1}}, Eigen::Vector3d::Zero());
  problem.dirichlet_dofs = {0, 2};
  problem.dirichlet_values = Eigen::Vector2d(1, 0);
  Solution s = active_set(problem);
  s.u(1) += 0.5e-8;  // a force of 1e-8; the clamps bear 1/2
  EXPECT_NEAR(kkt_report(problem, s).residual, 2e-8, 1e-14);
}

// u_1 is locked under a load of 1e6, u_0 = 1: the scale of u is 1, however much B bears.
TEST(Kkt, ALoadThatTheStiffFormBearsIsNoMeasureOfU) {
  VariationalInequality problem =
      small_problem(Eigen::Matrix2d::Identity(), Eigen::Vector2d(1, 1e6), Eigen::VectorXd::Zero(1),
                    Eigen::RowVector2d(0, 1), 0);
  Solution s;
  s.u = Eigen::Vector2d(1, 0);
  s.p = Eigen::VectorXd::Constant(1, 1e6);
  s.lambda = Eigen::VectorXd::Zero(1);
  EXPECT_EQ(worst_violation(kkt_report(problem, s)), 0);
  s.u(1) = 1e-3;
  s.penalised_max_u =
      1e3;  // the first iterate was larger: u is what counts, down to a millionth of that
  EXPECT_NEAR(kkt_report(problem, s).residual, 1e-3, 1e-15);
  s.u(1) = 0;
  problem.bounds.lower(0) = 1.001;
  EXPECT_NEAR(kkt_report(problem, s).min_gap, -1e-3 / 1.001, 1e-15);
}

TEST(Certify, RefusesTheAnswerOfAWrongContactSet) {
  for (const double epsilon : {1.0, 1e-2, 0.0}) {
    const Solved s(epsilon);
    // hold the wrong unknowns by fixing them where the obstacle is: a linear problem whose
    // equations all hold
    for (const bool one_more : {true, false}) {
      std::vector<bool> active = s.solution.active;
      if (one_more)
        active[loose(s.solution)] = true;
      else
        active[held(s.solution)] = false;
      Solution wrong = active_set(equality_constrained(s.problem, active));
      const SplitResidual r = exact_residual(s.problem, wrong.u, wrong.p, Eigen::VectorXd());
      wrong.lambda = Eigen::VectorXd::Zero(s.problem.bounds.lower.size());
      for (std::size_t i = 0; i < active.size(); ++i)
        if (active[i])
          wrong.lambda(static_cast<Eigen::Index>(i)) = -r.r1(s.problem.bounds.unknowns[i]);
      wrong.active = active;
      EXPECT_LT(kkt_report(s.problem, wrong).residual, 1e-8);
      EXPECT_THROW(check_kkt(s.problem, wrong), NotConverged)
          << "epsilon " << epsilon << ", one more: " << one_more;
    }
  }
}

TEST(Certify, RefusesWrongAnswersWithoutContactToo) {
  const Space space(structured_mesh(6), p1());
  const VariationalInequality problem = assemble(Scene({paper_load}, StiffLayer{0.1}), space);
  const Solution right = active_set(problem);
  Solution wrong = right;
  wrong.u *= 1.001;
  EXPECT_THROW(check_kkt(problem, wrong), NotConverged);
  wrong = right;
  wrong.p *= 1.001;
  EXPECT_THROW(check_kkt(problem, wrong), NotConverged);
  wrong = right;
  const int corner = 0;  // (0, -1): its neighbours' equations barely see it, only the clamp itself
  ASSERT_EQ(problem.dirichlet_dofs[0], corner);
  wrong.u(corner) = 1e-9;
  EXPECT_THROW(check_kkt(problem, wrong), NotConverged) << "a clamp that slipped";
  // the report is linear in what is wrong: above the lower level there is a warning
  wrong = right;
  wrong.p *= 1.001;
  const double unit = worst_violation(kkt_report(problem, wrong)) / 1e-3;
  for (const double reached : {3e-10, 3e-9}) {
    wrong = right;
    wrong.p *= 1 + reached / unit;
    check_kkt(problem, wrong);
    EXPECT_EQ(wrong.warning.empty(), reached < KktTolerances{}.warn) << wrong.warning;
  }
  VariationalInequality none = problem;
  none.load.setZero();
  EXPECT_EQ(worst_violation(active_set(none).kkt), 0) << "0 of nothing is 0";
}

}  // namespace antilock::test::solve_test::kkt_test
