// One call from a scene to its solution, which reports when the element has locked.
#include "antilock/analysis/solve.hpp"

#include "antilock/analysis/locking_report.hpp"
#include "antilock/solve/uzawa.hpp"
#include "support/scenes.hpp"

namespace antilock::test::analysis_test::solve_test {

TEST(Solve, WarnsWhereTheElementLocksAndNowhereElse) {
  const Space conforming(unstructured_mesh(16), p1());
  for (const double epsilon : {1e-2, 1e-6, 0.0}) {
    const Result locked = solve(stiff_scene(epsilon), conforming);
    ASSERT_TRUE(locked.locking);
    EXPECT_EQ(locked.warning, locked.locking->warning);
    EXPECT_TRUE(locked.warning.starts_with("P1 locks in this layer")) << locked.warning;
    EXPECT_TRUE(locked.solution.warning.empty())
        << "the discrete problem is solved: " << locked.solution.warning;
    const Result free = solve(stiff_scene(epsilon), Space(conforming, crouzeix_raviart()));
    ASSERT_TRUE(free.locking);
    EXPECT_EQ(free.warning, "");
  }
  const Result without = solve(Scene({paper_load}), Space(structured_mesh(8, {0}), p1()));
  EXPECT_FALSE(without.locking) << "there is no layer";
  EXPECT_EQ(without.warning, "");
}

TEST(Solve, IsAssembleAndActiveSetToTheLastBit) {
  for (const NamedSpace& space : two_square_spaces(8, {&p1(), &crouzeix_raviart()})) {
    const Scene scene = stiff_scene(1e-3);
    const VariationalInequality problem = assemble(scene, space);
    const Solution alone = active_set(problem);
    const Result result = solve(scene, space);
    EXPECT_EQ(result.solution.u, alone.u) << space.name;
    EXPECT_EQ(result.solution.p, alone.p) << space.name;
    EXPECT_EQ(result.solution.lambda, alone.lambda) << space.name;
    EXPECT_EQ(result.problem.load, problem.load) << space.name;
    EXPECT_EQ(&result.space.mesh(), &space.mesh()) << space.name;
  }
}

TEST(Solve, TakesOptionsOrAnotherSolver) {
  const Space space(structured_mesh(8), crouzeix_raviart());
  const Scene scene = stiff_scene(1e-3);
  ActiveSetOptions impatient;
  impatient.corrections.max_corrections = 0;
  EXPECT_THROW(solve(scene, space, impatient), NotConverged);
  const Result result =
      solve(scene, space, [](const VariationalInequality& problem) { return uzawa(problem); });
  EXPECT_EQ(result.solution.solver, uzawa(result.problem).solver);
  EXPECT_LT(relative_difference(result.solution.u, solve(scene, space).solution.u), 1e-8);
}

// Nothing is hidden behind the report: a warning of the solver stands beside it.
TEST(Solve, PutsTheWarningOfTheLayerBeforeThatOfTheSolver) {
  const auto doubtful = [](const VariationalInequality& problem) {
    Solution solution = active_set(problem);
    solution.warning = "a doubt";
    return solution;
  };
  const Space space(unstructured_mesh(8), p1());
  const Result locked = solve(stiff_scene(1e-6), space, doubtful);
  EXPECT_EQ(locked.warning, locked.locking->warning + "; a doubt");
  EXPECT_EQ(solve(stiff_scene(1e-6), Space(space, crouzeix_raviart()), doubtful).warning,
            "a doubt");
}

TEST(Solve, RefusesAMeshWithoutAFreeUnknown) {
  expect_refused([] { solve(Scene({paper_load}), Space(structured_mesh(1, {0}), p1())); },
                 "every unknown is fixed");
}

}  // namespace antilock::test::analysis_test::solve_test
