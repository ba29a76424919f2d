// Proximal Galerkin agrees with the active set at every compliance, or throws where K_h has no
// inner point.
#include "antilock/solve/proximal_galerkin.hpp"

#include "support/dense.hpp"
#include "support/random_contact.hpp"
#include "support/scenes.hpp"
#include "support/small_problem.hpp"

namespace antilock::test::solve_test::proximal_galerkin_test {

UnilateralContact gap() {
  return {[](double x) { return x * (x - 0.4) * (1 - x); }};
}

TEST(ProximalGalerkin, AgreesWithTheActiveSetAtEveryEpsilon) {
  for (const NamedSpace& space : two_square_spaces(10, {&p1(), &crouzeix_raviart()})) {
    for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-4, 1e-6, 0.0}) {
      if (&space.element() == &p1() && space.name.starts_with("unstructured") && epsilon < 1e-4)
        continue;  // below
      for (const UnilateralContact& obstacle : {UnilateralContact{}, gap()}) {
        const VariationalInequality problem = stiff_problem(space, epsilon, obstacle);
        const Solution proximal = proximal_galerkin(problem), direct = active_set(problem);
        EXPECT_LT(relative_difference(proximal.u, direct.u), 1e-10) << space.name << epsilon;
        EXPECT_LT(relative_difference(proximal.lambda, direct.lambda), 1e-8)
            << space.name << epsilon;
        EXPECT_EQ(proximal.active, direct.active) << space.name << epsilon;
        EXPECT_EQ(proximal.warning, direct.warning) << space.name << epsilon;
        EXPECT_GE(proximal.counters.contact_iterations, std::ssize(proximal.history));
        EXPECT_LE(proximal.history.back(), ProximalGalerkinOptions{}.tolerance);
      }
    }
  }
}

TEST(ProximalGalerkin, TheStepsDependNeitherOnTheMeshWidthNorOnEpsilon) {
  for (const int cells : {8, 16, 32})
    for (const double epsilon : {1.0, 1e-2, 1e-6, 0.0}) {
      const Solution s =
          proximal_galerkin(stiff_problem(Space(structured_mesh(cells), p1()), epsilon));
      EXPECT_LE(std::ssize(s.history), 15) << cells << " " << epsilon;
      EXPECT_LE(s.counters.contact_iterations, 80) << cells << " " << epsilon;
    }
}

TEST(ProximalGalerkin, RefusesAMeshThatLocksCompletely) {
  const Space space(unstructured_mesh(8), p1());
  const VariationalInequality problem = stiff_problem(space, 0);
  EXPECT_LT(active_set(problem).u(problem.bounds.unknowns).cwiseAbs().maxCoeff(), 1e-12)
      << "the active set answers 0";
  expect_refused([&] { proximal_galerkin(problem); },
                 "K_h has no inner point, as where an element locks");
  EXPECT_THROW(proximal_galerkin(problem), NotConverged);
}

TEST(ProximalGalerkin, RefusesTwoBoundsWhoseValuesHaveTheSumZero) {
  // u_0 + u_1 = 0 at compliance 0, u_0 >= 0, u_1 >= 0: each of them moves, but only in opposite
  // directions
  VariationalInequality problem =
      small_problem(Eigen::MatrixXd::Identity(2, 2), Eigen::VectorXd{{-1, 1}},
                    Eigen::VectorXd{{0, 0}}, Eigen::MatrixXd{{1, 1}}, 0);
  EXPECT_LT(active_set(problem).u.norm(), 1e-15);
  expect_refused([&] { proximal_galerkin(problem); }, "no solution of proximal step");
  // an inner point: u_0 + u_1 = 0, u_0 >= -1, u_1 >= 0
  problem.bounds.lower(0) = -1;
  problem.load = Eigen::VectorXd{{-5, 1}};
  EXPECT_LT(relative_difference(proximal_galerkin(problem).u, Eigen::VectorXd{{-1, 1}}), 1e-10);
}

TEST(ProximalGalerkin, LeavesOutABoundWhoseValueIsFixedInside) {
  // u_1 = 0 at compliance 0, above its bound -1
  const VariationalInequality problem =
      small_problem(chain(3), Eigen::VectorXd{{-1, 2, -3}}, Eigen::VectorXd{{-0.25, -1, -0.5}},
                    Eigen::MatrixXd{{0, 1, 0}}, 0);
  const Solution s = proximal_galerkin(problem);
  EXPECT_LT(relative_difference(s.u, Eigen::VectorXd{{-0.25, 0, -0.5}}), 1e-10);
  EXPECT_EQ(s.lambda(1), 0);
  EXPECT_EQ(s.active, (std::vector<bool>{true, false, true}));
}

TEST(ProximalGalerkin, AgreesOnRandomProblems) {
  RandomContact random;
  for (int trial = 0; trial < 200; ++trial) {
    random.next();
    const VariationalInequality problem = small_problem(random.s, random.q, random.lower);
    // the tolerance is one of s_i / sqrt(F_ii), which has up to 7 times the relative error in u
    const Solution direct = active_set(problem),
                   proximal = proximal_galerkin(problem, {.tolerance = 1e-11});
    EXPECT_LT(relative_difference(proximal.u, direct.u), 1e-10) << trial;
    EXPECT_EQ(proximal.active, direct.active) << trial;
  }
}

TEST(ProximalGalerkin, AgreesOnRandomProblemsWithStiffRowsAndTwoSides) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> kind(0, 2);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 4 + trial % 12, rows = 1 + trial % 3;
    Eigen::MatrixXd g(n, n), b(rows, n);
    Eigen::VectorXd load(n);
    for (Eigen::MatrixXd* matrix : {&g, &b})
      for (double& value : matrix->reshaped()) value = normal(random);
    for (double& value : load) value = 10 * normal(random);
    const Eigen::MatrixXd a1 = product(g, g.transpose()) + 0.1 * Eigen::MatrixXd::Identity(n, n);
    VariationalInequality problem =
        small_problem(a1, load, Eigen::VectorXd::Zero(n - rows - 1), b,
                      trial % 2 == 0 ? 0 : std::pow(10.0, -(trial % 16)));
    const int bounds = n - rows - 1;
    for (int i = 0; i < bounds; ++i) {
      problem.bounds.lower(i) = -std::abs(normal(random));
      const int sides = kind(random);
      if (sides > 0) problem.bounds.upper(i) = std::abs(normal(random));
      if (sides == 2) problem.bounds.lower(i) = -infinity;
    }
    const Solution direct = active_set(problem), proximal = proximal_galerkin(problem);
    EXPECT_LT(relative_difference(proximal.u, direct.u), 1e-10) << trial;
    EXPECT_EQ(proximal.status, direct.status) << trial;
  }
}

TEST(ProximalGalerkin, BoundsOnConstraintsAndPrescribedValuesAreLikeOthers) {
  VariationalInequality problem =
      small_problem(chain(5), Eigen::VectorXd{{-1, -2, -3, 2, 1}}, Eigen::VectorXd{{-1}});
  problem.bounds.constraints =
      RowMatrix(Eigen::MatrixXd{{0, 1, 0, -1, 0}, {0, 0, 2, 1, 0}}.sparseView());
  problem.bounds.lower = Eigen::VectorXd{{-1, -0.5, -infinity}};
  problem.bounds.upper = Eigen::VectorXd{{infinity, 0.5, -4}};
  problem.bounds.force_limit = Eigen::VectorXd::Constant(3, infinity);
  set_dirichlet(problem, {{4, 0.25}});
  const Solution direct = active_set(problem), proximal = proximal_galerkin(problem);
  EXPECT_GT(std::count(direct.active.begin(), direct.active.end(), true), 1);
  EXPECT_LT(relative_difference(proximal.u, direct.u), 1e-10);
  EXPECT_EQ(proximal.status, direct.status);
}

TEST(ProximalGalerkin, AgreesOrRefusesWhereTwoBoundsAreTheSame) {
  // u_0 >= -1 as a bound on the unknown and once more as a constraint: F is singular, and the
  // forces of both are not unique. u is.
  VariationalInequality problem =
      small_problem(chain(3), Eigen::VectorXd{{-4, -2, 1}}, Eigen::VectorXd{{-1}});
  problem.bounds.constraints = RowMatrix(Eigen::MatrixXd{{1, 0, 0}}.sparseView());
  problem.bounds.lower = Eigen::VectorXd{{-1, -1}};
  problem.bounds.upper = Eigen::VectorXd{{infinity, infinity}};
  problem.bounds.force_limit = problem.bounds.upper;
  const VariationalInequality once =
      small_problem(chain(3), Eigen::VectorXd{{-4, -2, 1}}, Eigen::VectorXd{{-1}});
  Eigen::VectorXd u = active_set(once).u;
  const std::string message = refusal([&] { u = proximal_galerkin(problem).u; });
  EXPECT_LT(relative_difference(u, active_set(once).u), 1e-10);
  const std::string accepted =
      "accepted: a K_h with an inner point, and bounds on independent values";
  EXPECT_TRUE(message.empty() || message.find(accepted) != message.npos) << message;
}

TEST(ProximalGalerkin, AgreesWhereContactGrazes) {
  // the solution without a bound on u_2 has u_2 = -0.25, its bound: lambda_2 = 0
  const VariationalInequality problem = small_problem(
      chain(5), Eigen::VectorXd{{-1, -2, 0.5, 1, -3}}, Eigen::VectorXd{{-0.5, -1, -0.25, 0, -2}});
  const Solution proximal = proximal_galerkin(problem);
  // the distance is halved in each step and ends below the tolerance of 1e-10
  EXPECT_LT(relative_difference(proximal.u, Eigen::VectorXd{{-0.5, -1, -0.25, 0, -1.5}}), 1e-9);
  EXPECT_LE(std::ssize(proximal.history), 40);
}

TEST(ProximalGalerkin, DoesNotTakeShortStepsForConvergence) {
  ProximalGalerkinOptions options;
  options.step_length = [](int) { return 1e-12; };  // s hardly changes
  const VariationalInequality problem =
      small_problem(chain(2), Eigen::VectorXd{{-1, -2}}, Eigen::VectorXd{{0, 0}});
  EXPECT_THROW(proximal_galerkin(problem, options), NotConverged);
}

TEST(ProximalGalerkin, UnitsChangeNothing) {
  const Eigen::VectorXd load{{-1, -2, 0.25, 1, -3}}, lower{{-0.5, -1, -0.25, 0, -2}},
      unit{{1, 1e4, 1e-4, 1, 1e2}};
  const Solution plain = proximal_galerkin(small_problem(chain(5), load, lower));
  const Solution scaled =
      proximal_galerkin(small_problem(1e3 * (unit.asDiagonal() * chain(5) * unit.asDiagonal()),
                                      1e3 * unit.cwiseProduct(load), lower.cwiseQuotient(unit)));
  EXPECT_LT(relative_difference(unit.cwiseProduct(scaled.u), plain.u), 1e-10);
  EXPECT_EQ(scaled.counters.contact_iterations, plain.counters.contact_iterations);
  EXPECT_EQ(scaled.history.size(), plain.history.size());
}

TEST(ProximalGalerkin, WithoutBoundsOrContactIsOneLinearSolve) {
  VariationalInequality problem =
      small_problem(chain(3), Eigen::VectorXd{{1, 2, 3}}, Eigen::VectorXd{{0, 0, 0}});
  for (const bool bounds : {true, false}) {
    if (!bounds) problem.bounds = {};
    const Solution s = proximal_galerkin(problem);
    EXPECT_LT(relative_difference(s.u, active_set(problem).u), 1e-12);
    EXPECT_EQ(s.counters.contact_iterations, 0);
    EXPECT_EQ(s.lambda.norm(), 0);
  }
}

TEST(ProximalGalerkin, AFactorServesEveryLoadAndCompliance) {
  const Space space(structured_mesh(6), p1());
  VariationalInequality linear = stiff_problem(space, 1e-3);
  linear.bounds = {};
  PenalisedCholesky factor(linear);
  for (const double epsilon : {1e-3, 1e-4, 0.0}) {
    VariationalInequality problem = stiff_problem(space, epsilon, gap());
    problem.load *= 2;
    const Solution s = proximal_galerkin(problem, factor);
    EXPECT_LT(relative_difference(s.u, active_set(problem).u), 1e-10) << epsilon;
    EXPECT_EQ(s.counters.factorisations, 1);
  }
  PenalisedCholesky bounded(stiff_problem(space, 1e-3));
  EXPECT_NE(refusal([&] { proximal_galerkin(stiff_problem(space, 1e-3), bounded); }), "");
}

/// 2 u = -10 + lambda, u >= -1.
VariationalInequality one_spring() {
  return small_problem(Eigen::MatrixXd::Constant(1, 1, 2), Eigen::VectorXd{{-10}},
                       Eigen::VectorXd{{-1}});
}

TEST(ProximalGalerkin, OneUnknownFollowsItsEquation) {
  // one step of length alpha: -1 + r exp(psi) + F c psi / alpha = -5, F = 1/2, r = 4, c F = 4:
  // exp(psi) + psi / alpha = -1
  ProximalGalerkinOptions options;
  for (const double alpha : {0.5, 1.0, 16.0}) {
    options.step_length = [=](int) { return alpha; };
    options.tolerance = 1e3;  // one step
    double psi = -1;
    for (int i = 0; i < 100; ++i)
      psi -= (std::exp(psi) + psi / alpha + 1) / (std::exp(psi) + 1 / alpha);
    const Solution s = proximal_galerkin(one_spring(), options);
    ASSERT_EQ(s.history.size(), 1U);
    EXPECT_NEAR(s.u(0), -1 + 4 * std::exp(psi), 1e-12) << alpha;
    EXPECT_NEAR(s.lambda(0), -8 * psi / alpha, 1e-11) << alpha;
  }
}

// A step that is not finite has not converged, and the largest entry decides.
TEST(ProximalGalerkin, MeasuresANewtonStepByTheChangeOfTheLatentVariable) {
  const Eigen::Vector2d moved(0, -1e3);
  EXPECT_TRUE(newton_step_has_converged(Eigen::Vector2d(1e-8, 1e-5), moved));
  EXPECT_FALSE(newton_step_has_converged(Eigen::Vector2d(1e-5, 1e-8), moved));
  EXPECT_FALSE(newton_step_has_converged(Eigen::Vector2d(1e-8, -1e-3), moved));
  EXPECT_FALSE(newton_step_has_converged(Eigen::Vector2d(nan, 0), moved));
}

TEST(ProximalGalerkin, RefusesWhatItCannotSolve) {
  VariationalInequality problem = one_spring();
  ProximalGalerkinOptions options;
  for (const double length : {0.0, -1.0, nan, infinity}) {
    options.step_length = [=](int) { return length; };
    expect_refused([&] { proximal_galerkin(problem, options); }, "accepted: a positive number");
  }
  options = {};
  options.tolerance = 0;
  expect_refused([&] { proximal_galerkin(problem, options); }, "accepted: above 0");
  options = {};
  options.max_newton_steps = 0;
  expect_refused([&] { proximal_galerkin(problem, options); }, "accepted: 1 or more of each");
  options = {};
  options.max_proximal_steps = 2;
  const auto error = thrown<NotConverged>([&] { proximal_galerkin(problem, options); });
  EXPECT_EQ(error.steps, 2);
  EXPECT_GT(error.reached, options.tolerance);
  problem.bounds.upper = problem.bounds.lower;
  expect_refused([&] { proximal_galerkin(problem); }, "is an equation");
  problem.bounds.upper = Eigen::VectorXd{{infinity}};
  problem.bounds.force_limit = Eigen::VectorXd{{1}};
  expect_refused([&] { proximal_galerkin(problem); }, "friction is not known here");
  problem = one_spring();
  problem.load(0) = nan;
  EXPECT_NE(refusal([&] { proximal_galerkin(problem); }), "");
}

}  // namespace antilock::test::solve_test::proximal_galerkin_test
