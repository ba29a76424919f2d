// Coulomb's friction as the fixed point of Tresca's problem, on one point whose solution is known.
#include "antilock/solve/coulomb_friction.hpp"

#include "support/scenes.hpp"

namespace antilock::test::solve_test::coulomb_friction_test {

/// One point with the displacements (n, t), pressed down by 1 and pulled to the right by 2. The
/// stiffness is (4, 1; 1, 1): in contact lambda = 1 + t, and where it slips t = 2 - g. So the step
/// g -> F lambda is g -> F (3 - g), whose contraction is F.
VariationalInequality pulled_point() {
  VariationalInequality problem;
  Eigen::MatrixXd stiffness(2, 2);
  stiffness << 4, 1, 1, 1;
  problem.a1 = stiffness.sparseView();
  problem.b.resize(0, 2);
  problem.load = Eigen::Vector2d(-1, 2);
  problem.bounds = Bounds({0, 1}, BoundLimits(Eigen::Vector2d(0, 0), Eigen::Vector2d(infinity, 0),
                                              Eigen::Vector2d(infinity, 0)));
  return problem;
}

CoulombSolution solved(VariationalInequality& problem, double coefficient) {
  const std::vector<FrictionPair> pairs{{0, 1}};
  return coulomb_friction(problem, pairs, {coefficient},
                          [](const VariationalInequality& tresca) { return active_set(tresca); });
}

TEST(Coulomb, SlipsWithTheLimitOfItsOwnPressure) {
  for (const double f : {0.1, 0.3, 0.6}) {
    VariationalInequality problem = pulled_point();
    const CoulombSolution found = solved(problem, f);
    const double limit = 3 * f / (1 + f);
    // the tolerance of the fixed point is 1e-8 of the limit, which is at most 1.2
    EXPECT_NEAR(found.solution.lambda(0), limit / f, 1e-7) << f;
    EXPECT_NEAR(found.solution.lambda(1), -limit, 1e-7) << f;
    EXPECT_NEAR(found.solution.u(1), 2 - limit, 1e-7) << f;
    EXPECT_NEAR(found.solution.u(0), 0, 1e-14) << f;
    EXPECT_NEAR(found.report.contraction, f, 1e-4) << f;
    EXPECT_NEAR(problem.bounds.force_limit(1), limit, 1e-7) << f;
  }
}

// With F = 2.5 it sticks: lambda = 1, and the force 2 is below 2.5. The limits of all later steps
// are equal.
TEST(Coulomb, SticksWhereTheLimitIsNotReached) {
  VariationalInequality problem = pulled_point();
  const CoulombSolution found = solved(problem, 2.5);
  EXPECT_NEAR(found.solution.u(1), 0, 1e-14);
  EXPECT_NEAR(found.solution.lambda(1), -2, 1e-12);
  EXPECT_NEAR(found.solution.lambda(0), 1, 1e-12);
  EXPECT_LE(found.report.steps, 3);
}

// g = 1.8 is a fixed point for F = 1.5, but the steps jump between 1.5 and 2.25.
TEST(Coulomb, IsRefusedWhereTheFixedPointDoesNotContract) {
  VariationalInequality problem = pulled_point();
  const NotConverged failure = thrown<NotConverged>([&] { solved(problem, 1.5); });
  EXPECT_NE(std::string(failure.what()).find("does not contract"), std::string::npos);
  EXPECT_EQ(failure.steps, 6);
}

TEST(Coulomb, IsRefusedWhereTheFixedPointContractsTooSlowly) {
  VariationalInequality problem = pulled_point();
  // 0.9^100 is 3e-5
  const NotConverged failure = thrown<NotConverged>([&] { solved(problem, 0.9); });
  EXPECT_NE(std::string(failure.what()).find("by the factor 0.9 per step"), std::string::npos)
      << failure.what();
  EXPECT_EQ(failure.steps, 100);
}

TEST(Coulomb, NeedsNoFrictionWhereNothingTouches) {
  VariationalInequality problem = pulled_point();
  problem.load(0) = 10;  // lifted
  const CoulombSolution found = solved(problem, 0.3);
  EXPECT_EQ(found.solution.lambda.cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(found.report.steps, 1);
}

TEST(Coulomb, RefusesPairsOfNoBoundsAndNoCoefficient) {
  VariationalInequality problem = pulled_point();
  const auto solver = [](const VariationalInequality& tresca) { return active_set(tresca); };
  const std::vector<FrictionPair> pair{{0, 1}};
  const std::vector<FrictionPair> of_no_bound{{0, 2}};
  expect_refused([&] { coulomb_friction(problem, of_no_bound, {0.3}, solver); }, "below 2");
  expect_refused([&] { coulomb_friction(problem, pair, {0.0}, solver); }, "above 0");
}

}  // namespace antilock::test::solve_test::coulomb_friction_test
