// The active set with its iterated penalty: one answer, the right one, whatever the scale, the
// numbering and epsilon.
#include "antilock/core/dense.hpp"
#include "antilock/solve/anderson.hpp"
#include "antilock/solve/summed.hpp"
#include "antilock/solve/uzawa.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/sweep.hpp"
#include "support/brute_force.hpp"
#include "support/dense.hpp"
#include "support/scenes.hpp"
#include "support/small_problem.hpp"

namespace antilock::test::solve_test::active_set_test {

/// Obstacles: touching, below, pressing in, and one that presses in on the left only.
std::vector<UnilateralContact> obstacles() {
  return {{[](double) { return 0.0; }},
          {[](double) { return 0.02; }},
          {[](double x) { return -0.05 * std::sin(std::numbers::pi * x); }},
          {[](double x) { return x * (x - 0.4) * (1 - x); }}};
}

TEST(ActiveSet, IsTheBruteForceAnswer) {
  for (const NamedSpace& space : two_square_spaces(4, {&p1(), &crouzeix_raviart()})) {
    for (const double epsilon : {1.0, 0.1, 1e-2, 1e-4, 0.0}) {
      if (epsilon == 0 && &space.element() == &p1() && space.name.starts_with("unstructured"))
        continue;  // locked: lambda is not unique
      for (std::size_t k = 0; k < obstacles().size(); ++k) {
        SCOPED_TRACE(space.name + ", epsilon " + std::to_string(epsilon) + ", obstacle " +
                     std::to_string(k));
        const VariationalInequality problem = stiff_problem(space, epsilon, obstacles()[k]);
        const test::BruteForce exact = test::brute_force(problem);
        const Solution solution = active_set(problem);
        // corrections stop at an estimated 1e-10
        EXPECT_LT(relative_difference(solution.u, exact.u), 1e-9);
        EXPECT_LT((solution.lambda - exact.lambda).cwiseAbs().maxCoeff(),
                  1e-8 * (problem.load.cwiseAbs().maxCoeff() + exact.lambda.cwiseAbs().maxCoeff()));
        EXPECT_EQ(solution.active, exact.active);
        if (epsilon > 0) {
          const Eigen::VectorXd p = problem.b * exact.u / problem.compliance;
          // digits of B u that epsilon^-2 leaves in double precision
          EXPECT_LT(relative_difference(solution.p, p), 1e-8 + 1e-15 / problem.compliance);
        }
      }
    }
  }
}

TEST(ActiveSet, LimitProblemOnAStructuredMeshIsVentcels) {
  // at epsilon = 0 the layer's u is constant along y, and its energy is the Ventcel term: (24) is
  // (25), also discretely
  const TriangleMesh both = structured_mesh(12), body = structured_mesh(12, {0});
  for (const Element* element : {&p1(), &crouzeix_raviart()})
    for (const UnilateralContact& obstacle : obstacles()) {
      const Space on_both(both, *element), on_body(body, *element);
      const VariationalInequality in_layer = stiff_problem(on_both, 0, obstacle),
                                  on_line = assemble(Scene({paper_load}, VentcelLayer{}, obstacle),
                                                     on_body);
      const Solution limit = active_set(in_layer), ventcel = active_set(on_line);
      EXPECT_LT(
          relative_difference(limit.u(on_both.contact_dofs()), ventcel.u(on_body.contact_dofs())),
          1e-8);
      EXPECT_NEAR(energy(in_layer, limit), energy(on_line, ventcel), 1e-9);
      EXPECT_LT(relative_difference(limit.lambda, ventcel.lambda), 1e-8);
      EXPECT_EQ(limit.active, ventcel.active);
    }
}

TEST(ActiveSet, TendsToTheLimitLikeEpsilonSquared) {
  const Space space(unstructured_mesh(8), crouzeix_raviart());
  const Eigen::VectorXd limit = active_set(stiff_problem(space, 0)).u;
  const double far = relative_difference(active_set(stiff_problem(space, 1e-2)).u, limit);
  const double near = relative_difference(active_set(stiff_problem(space, 1e-3)).u, limit);
  EXPECT_NEAR(std::log10(far / near), 2, 0.1);
  // at 1e-7 the difference is below the accuracy of the solver: right down to there
  EXPECT_LT(relative_difference(active_set(stiff_problem(space, 1e-7)).u, limit), 1e-9);
}

TEST(ActiveSet, NestedStartKeepsTheStepsAtFourAndCorrectionsAtTen) {
  for (const int cells : {16, 32, 64, 128})
    for (const bool structured : {true, false}) {
      const TriangleMesh mesh = structured ? structured_mesh(cells) : unstructured_mesh(cells);
      for (const Element* element : {&p1(), &crouzeix_raviart()}) {
        if (!structured && element == &p1()) continue;  // locks: another test
        const Space space(mesh, *element);
        for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-4, 1e-6, 0.0}) {
          if (cells == 128 && epsilon != 1e-1 && epsilon != 0)
            continue;  // the two hardest, for the sake of time
          const Counters c = active_set(stiff_problem(space, epsilon)).counters;
          const std::string where = element->name() + (structured ? "" : " unstructured") +
                                    ", 1/h = " + std::to_string(cells) +
                                    ", epsilon = " + std::to_string(epsilon);
          EXPECT_LE(c.contact_iterations, 4) << where;
          EXPECT_GE(c.contact_iterations, 1) << where;
          EXPECT_LE(c.corrections, 10) << where;
          EXPECT_EQ(c.factorisations, 1) << where;
        }
      }
    }
}

TEST(ActiveSet, NeverReturnsAnUnconvergedAnswer) {
  const Space space(unstructured_mesh(8), crouzeix_raviart());
  const VariationalInequality problem = stiff_problem(space, 0);
  ActiveSetOptions options;
  const int needed = active_set(problem).counters.corrections;
  for (int most = 0; most < needed; ++most) {
    options.corrections.max_corrections = most;
    const auto error = thrown<NotConverged>([&] { active_set(problem, options); });
    EXPECT_EQ(error.steps, most);
    EXPECT_GT(error.reached, options.corrections.tolerance);
  }
  options.corrections.max_corrections = needed;
  EXPECT_NO_THROW(active_set(problem, options));

  options = {};
  options.max_contact_iterations = 1;
  options.start = BoundStatuses(problem.bounds.unknowns.size(), BoundStatus::at_lower);
  EXPECT_THROW(active_set(problem, options), NotConverged);
  options.start->push_back(BoundStatus::inactive);
  expect_refused([&] { active_set(problem, options); }, "contact: the start has");
}

// x -> x + g(x) contracts by 0.9 in one unknown and by 0.1 in the others. A mix makes g fall faster
// than the plain steps do, and an error estimate made of that would stop ten times too early.
TEST(Anderson, TheContractionIsThatOfThePlainSteps) {
  const Eigen::VectorXd rate = Eigen::Vector4d(0.9, 0.1, 0.08, 0.05),
                        fixed_point = Eigen::Vector4d(1, 1, -2, 3);
  Anderson anderson;
  DoubleDoubleVector x(Eigen::VectorXd::Zero(4)), companion = x;
  double before = 1;
  for (int step = 0; step < 5; ++step) {
    const Eigen::VectorXd g = (1 - rate.array()) * (fixed_point - x.high).array();
    x += g;
    companion += g;
    anderson.push(x, g, companion);
    if (step == 0) {
      EXPECT_EQ(anderson.contraction(), 0.99) << "one step tells nothing";
    }
    if (step == 4) {  // measured: 0.011, and 0.900
      EXPECT_LT(g.norm() / before, 0.05) << "what the sizes of the steps pretend";
      EXPECT_GT(anderson.contraction(), 0.85);
      EXPECT_LE(anderson.contraction(), 0.9 * (1 + 1e-12));
    }
    before = g.norm();
    anderson.mix(x, companion);
    EXPECT_EQ(x.high, companion.high) << "mixed with the same weights";
  }
}

// Locked P1 under a penalty a hundred times too large: corrections contract by 0.9, and the answer
// is still right.
TEST(ActiveSet, SlowCorrectionsDoNotStopEarly) {
  const TriangleMesh mesh = unstructured_mesh(8);
  const VariationalInequality problem = stiff_problem(Space(mesh, p1()), 1e-6);
  const Solution right = active_set(problem);
  for (const double penalty : {1e-3, 5e-3, 2e-2}) {
    ActiveSetOptions options;
    options.penalty = penalty;
    const Solution slow = active_set(problem, options);
    EXPECT_GT(slow.counters.corrections, right.counters.corrections) << penalty;
    EXPECT_LT(relative_difference(slow.u, right.u), 3e-10)
        << penalty;  // twice the tolerance, and |u| < |u before|
  }
}

TEST(PenalisedCholesky, ForwardAndBackwardSolveWithK) {
  const Space space(unstructured_mesh(6), crouzeix_raviart());
  const VariationalInequality problem = stiff_problem(space, 0.1);
  PenalisedCholesky factor(problem, 0.01);
  EXPECT_EQ(PenalisedCholesky(problem).delta(), problem.compliance);  // 0.01, above h^2 / 16
  for (const double delta : {0.01, 1e-4}) {
    factor.refactor(delta);
    EXPECT_EQ(factor.delta(), delta);
    const std::vector<int>& unknown = factor.ordering().dof;
    const Eigen::MatrixXd k =
        Eigen::MatrixXd(problem.a1) + test::gram(problem.b, problem.m) / delta;
    const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(problem.free_count(), -1, 2);
    const Eigen::VectorXd x = factor.cholesky().backward(factor.cholesky().forward(r));
    const Eigen::VectorXd exact = Cholesky(k(unknown, unknown)).solve(r);
    EXPECT_LT(relative_difference(x, exact), 1e-10) << delta;
  }
  EXPECT_EQ(factor.factorisations(), 3);
}

// A harder question moves its delta, and one too small for its digits is raised; each question has
// the answer of its own.
TEST(PenalisedCholesky, ServesEveryComplianceAndEveryDeltaAskedFor) {
  VariationalInequality graded =
      small_problem(Eigen::Vector3d(1, 1e-8, 1e-8).asDiagonal(), Eigen::Vector3d(1, 1e-8, 0),
                    Eigen::VectorXd(), Eigen::Matrix<double, 2, 3>{{1, 0, 0}, {0, 1, 1}});
  PenalisedCholesky factor(graded, 1);
  Sweep sweep(graded);
  for (const double c :
       {1.0, 0.0, 1.0,
        0.0}) {  // u_1 = 1 / (1 + 1 / c), u_2 - u_3 = 1, u_2 + u_3 = 1 / (1 + 2e8 / c)
    graded.compliance = c;
    sweep.set_compliance(c);
    const double sum = c / (c + 2e8);
    for (const Solution& s : {active_set(graded, factor), sweep.solve(), sweep.solve()})
      EXPECT_LT((s.u - Eigen::Vector3d(c / (c + 1), (sum + 1) / 2, (sum - 1) / 2)).norm(), 1e-9)
          << c;
  }
}

TEST(ActiveSet, EndsWhereNumbersOverflowAndRefusesATolerance0) {
  VariationalInequality problem =
      small_problem(Eigen::Matrix2d{{1, -0.99}, {-0.99, 1}}, Eigen::Vector2d(1e307, 1e307),
                    Eigen::Vector2d(0, 0));
  problem.bounds.upper = Eigen::Vector2d(1, 2);
  EXPECT_EQ(active_set(problem).u, problem.bounds.upper);
  ActiveSetOptions options;
  options.corrections.tolerance = 0;
  EXPECT_THROW(active_set(problem, options), Error);
}

TEST(Combinations, LeaveTiedRowsTied) {
  VariationalInequality problem =
      small_problem(Eigen::Matrix2d{{2, -1}, {-1, 2}}, Eigen::Vector2d(1, 0.5), {},
                    Eigen::RowVector2d(1, 1), 1e-3);
  problem.fixed_compliances = Eigen::VectorXd::Zero(1);
  const RowMatrix row = Eigen::MatrixXd(Eigen::RowVector2d(1, -3)).sparseView();
  problem.bounds = {{}, BoundLimits(Eigen::VectorXd::Constant(1, -10)), row};
  EXPECT_NEAR(active_set(problem).u.sum(), 0, 1e-15);
}

TEST(Progress, IsReportedOncePerCorrectionAndStopsTheSolve) {
  const Space space(structured_mesh(8), p1());
  const VariationalInequality problem = test::stiff_problem(space, 1e-6);
  const Solution alone = active_set(problem);
  std::vector<Progress> seen;
  ActiveSetOptions options;
  options.corrections.progress = [&](const Progress& now) {
    seen.push_back(now);
    return true;
  };
  const Solution followed = active_set(problem, options);
  EXPECT_EQ(followed.u, alone.u);
  ASSERT_EQ(static_cast<int>(seen.size()),
            followed.counters.corrections);  // the last one is the answer
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].step, static_cast<int>(i) + 1);
    EXPECT_EQ(seen[i].tolerance, options.corrections.tolerance);
  }
  options.corrections.progress = [](const Progress& now) { return now.step < 2; };
  const auto stopped = thrown<Interrupted>([&] { active_set(problem, options); });
  EXPECT_EQ(stopped.steps, 2);
  EXPECT_NE(std::string(stopped.what()).find("stopped as asked"), std::string::npos)
      << stopped.what();
}

TEST(Progress, StopsUzawaAmongItsSteps) {
  const Space space(structured_mesh(16), p1());
  const VariationalInequality problem = test::stiff_problem(space, 0.1);
  UzawaOptions options;
  options.step_length = 1e-3;  // far too short: thousands of steps
  options.progress = [](const Progress& now) { return now.stage != "contact"; };
  EXPECT_EQ(thrown<Interrupted>([&] { uzawa(problem, options); }).steps, 32);
}

}  // namespace antilock::test::solve_test::active_set_test
