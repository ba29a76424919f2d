// Uzawa, the paper's algorithm: slow, but to the same answer; or no answer.
#include "antilock/solve/uzawa.hpp"
#include "antilock/certificate/balanced_tolerance.hpp"
#include "antilock/core/dense.hpp"
#include "antilock/core/eigenvalues.hpp"
#include "antilock/exact/exact_table.hpp"
#include "antilock/solve/summed.hpp"
#include "support/dense.hpp"
#include "support/scenes.hpp"
#include "support/small_problem.hpp"

namespace antilock::test::solve_test::uzawa_test {

UnilateralContact gap() {
  return {[](double x) { return x * (x - 0.4) * (1 - x); }};
}

TEST(Uzawa, AgreesWithTheActiveSet) {
  for (const NamedSpace& space : two_square_spaces(10, {&p1(), &crouzeix_raviart()})) {
    for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-6, 0.0}) {
      if (&space.element() == &p1() && space.name.starts_with("unstructured") && epsilon < 1e-2)
        continue;  // locked: lambda without bounds
      const VariationalInequality problem = stiff_problem(space, epsilon, gap());
      const Solution slow = uzawa(problem), fast = active_set(problem);
      EXPECT_LT(relative_difference(slow.u, fast.u), 1e-7) << space.name << epsilon;
      EXPECT_EQ(slow.active, fast.active) << space.name << epsilon;
      EXPECT_GT(slow.counters.contact_iterations, 3 * fast.counters.contact_iterations);
      EXPECT_EQ(std::ssize(slow.history), slow.counters.contact_iterations);
      EXPECT_LE(slow.history.back(), UzawaOptions{}.tolerance);
    }
  }
}

TEST(Uzawa, WithThePapersLinearSolverAgreesWhereItWorks) {
  const TriangleMesh mesh = structured_mesh(8);
  for (const Element* element : {&p1(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    for (const double epsilon : {1.0, 1e-1}) {
      const VariationalInequality problem = stiff_problem(space, epsilon, gap());
      const Solution paper = uzawa_cg_ilut(problem);
      EXPECT_LT(relative_difference(paper.u, active_set(problem).u), 1e-7)
          << element->name() << epsilon;
      EXPECT_EQ(static_cast<int>(paper.history.size()), paper.counters.contact_iterations);
      EXPECT_GE(paper.counters.solves, paper.counters.contact_iterations);
    }
  }
  expect_refused([&] { uzawa_cg_ilut(stiff_problem(Space(mesh, p1()), 0)); }, "epsilon = 0");
}

TEST(Uzawa, RefusesAStepThatGoesNowhere) {
  const TriangleMesh mesh = structured_mesh(4);
  const VariationalInequality problem = stiff_problem(Space(mesh, p1()), 1);
  for (const double step : {0.0, -1.0, nan}) {
    UzawaOptions options;
    options.step_length = step;
    expect_refused([&] { uzawa(problem, options); }, "accepted: a positive number");
    expect_refused([&] { uzawa_cg_ilut(problem, options); }, "accepted: a positive number");
  }
  UzawaOptions options;
  options.stop_at = {1e-6, 1e-3};
  expect_refused([&] { uzawa_cg_ilut(problem, options); }, "options.stop_at");
}

TEST(Uzawa, WithThePapersLinearSolverIsRightOrSaysThatItIsNot) {
  // on meshes that are not aligned ILUT breaks down for small epsilon: an exception, or an answer
  // that holds
  for (const auto& [name, mesh] : two_square_meshes(8)) {
    const Space space(mesh, crouzeix_raviart());
    for (const double epsilon : {1e-2, 1e-4, 1e-6, 1e-8, 1e-12}) {
      const VariationalInequality problem = stiff_problem(space, epsilon);
      UzawaOptions options;
      options.max_iterations = 2000;
      try {
        const Solution paper = uzawa_cg_ilut(problem, options);
        EXPECT_LT(worst_violation(kkt_report(problem, paper)), 1e-6) << name << epsilon;
      } catch (const NotConverged&) {
      }
    }
  }
}

TEST(Uzawa, StopsWhereItIsAccurateEnough) {
  constexpr int cells = 32;
  const auto stop = [](const std::string& element_name, const TriangleMesh& mesh,
                       const TriangleMesh& coarse) {
    const Space space(mesh, element(element_name));
    for (const double epsilon : {1.0, 1e-2, 1e-6}) {
      const ExactTable exact_solution(ExactSolution(paper_sine_load(), epsilon, true, 14));
      const VariationalInequality problem = stiff_problem(space, epsilon);
      UzawaOptions options;
      const Solution full = uzawa(problem);
      options.stop_at = balanced_tolerance(energy_bounds(test::stiff_scene(epsilon), coarse), 2);
      const Solution early = uzawa(problem, options);
      EXPECT_LT(2 * early.counters.contact_iterations, full.counters.contact_iterations)
          << element_name << epsilon;  // it looks every 32 steps
      EXPECT_LE(early.counters.corrections, full.counters.corrections);
      const Errors a = measure_errors(space, full, epsilon, reference(exact_solution)),
                   b = measure_errors(space, early, epsilon, reference(exact_solution));
      // the promise of balanced_tolerance
      EXPECT_LT(b.max, 1.01 * a.max) << element_name << epsilon;
      EXPECT_LT(b.h1, 1.01 * a.h1) << element_name << epsilon;
      EXPECT_LT(b.energy, 1.01 * a.energy) << element_name << epsilon;
    }
  };
  stop("P1", structured_mesh(cells), structured_mesh(cells / 2));
  stop("CR", unstructured_mesh(cells), unstructured_mesh(cells / 2));
}

TEST(Uzawa, TheDualityGapBoundsWhatIsLeft) {
  const TriangleMesh mesh = structured_mesh(16);
  for (const UnilateralContact& obstacle : {UnilateralContact{}, gap()}) {
    // epsilon^2 > penalty: one matrix, no corrections, so that |u - u_h|_a^2 / 2 is below the gap
    // to the last digit
    const VariationalInequality problem =
        stiff_problem(Space(mesh, crouzeix_raviart()), 1e-2, obstacle);
    const Eigen::VectorXd exact = active_set(problem).u;
    UzawaOptions options;
    int steps = 0;
    for (const double energy : {1e-4, 1e-6, 1e-8, 1e-10}) {
      options.stop_at = {energy, 1e-3};
      const Solution s = uzawa(problem, options);
      const Eigen::VectorXd e = s.u - exact, strain = problem.b * e;
      const double left = 0.5 * (e.dot(problem.a1 * e) +
                                 strain.dot(problem.m.cwiseProduct(strain)) / problem.compliance);
      EXPECT_LE(left, energy);
      EXPECT_GE(s.counters.contact_iterations, steps) << "more asked, more steps";
      steps = s.counters.contact_iterations;
    }
    EXPECT_GT(steps, 32) << "the gap is asked for once per 32 steps";
  }
}

TEST(Uzawa, TheStepLengthChangesTheCostNotTheAnswer) {
  const TriangleMesh mesh = structured_mesh(8);
  const VariationalInequality problem = stiff_problem(Space(mesh, p1()), 1);
  const Solution chosen = uzawa(problem);
  // the largest eigenvalue of the compliance bounds the step from above by 2 over it
  const PenalisedCholesky factor(problem);
  const Eigen::MatrixXd& l = factor.contact_block();
  const double largest = 1 / symmetric_eigenvalues(test::product(l, l.transpose())).minCoeff();
  UzawaOptions options;
  for (const double step : {0.3, 1.0, 1.9}) {
    options.step_length = step / largest;
    const Solution s = uzawa(problem, options);
    EXPECT_LT(relative_difference(s.u, chosen.u), 1e-7) << step;
    EXPECT_GE(1.2 * s.counters.contact_iterations, chosen.counters.contact_iterations)
        << "the chosen step is about the best, " << step;
  }
  options.step_length = 4 / largest;  // beyond the bound: it swings for ever
  options.max_iterations = 5000;
  EXPECT_THROW(uzawa(problem, options), NotConverged);
}

/// A chain of five springs in units that lie 4 decades apart, so that its compliances lie 8 apart,
/// over an obstacle.
VariationalInequality chain_in_units_apart() {
  const Eigen::VectorXd unit{{1, 1e4, 1e-4, 1, 1e2}};
  return small_problem(unit.asDiagonal() * chain(5) * unit.asDiagonal(),
                       unit.cwiseProduct(Eigen::VectorXd{{-1, -2, 0.5, 1, -3}}),
                       Eigen::VectorXd{{-0.5, -1, -0.25, 0, -2}}.cwiseQuotient(unit));
}

TEST(Uzawa, UnitsDecadesApartTakeAStepEach) {
  const VariationalInequality problem = chain_in_units_apart();
  const Solution exact = active_set(problem), s = uzawa(problem);
  EXPECT_LT(s.counters.contact_iterations, 500);  // one step for all takes more than a million
  EXPECT_EQ(s.active, exact.active);
  EXPECT_LT(relative_difference(s.u, exact.u), 1e-9);
}

TEST(Uzawa, StepsFindTheForcesOfEquations) {
  VariationalInequality problem = chain_in_units_apart();
  problem.bounds.lower(1) = problem.bounds.upper(1) = 0.25e-4;
  problem.bounds.lower(3) = problem.bounds.upper(3) = -0.125;
  const Solution exact = active_set(problem), s = uzawa(problem);
  EXPECT_LT(relative_difference(s.u, exact.u), 1e-9);
  EXPECT_EQ(s.active, exact.active);
}

/// 2 u = -10 + lambda, u >= -1.
VariationalInequality one_spring() {
  return small_problem(Eigen::MatrixXd::Constant(1, 1, 2), Eigen::VectorXd{{-10}},
                       Eigen::VectorXd{{-1}});
}

TEST(Uzawa, OneUnknownStopsAtEitherBound) {
  VariationalInequality problem = one_spring();
  problem.bounds.upper = Eigen::VectorXd{{3}};
  for (const double load : {-10.0, -1.0, 0.0, 5.0, 10.0}) {  // 2 u = load + lambda
    problem.load(0) = load;
    const Solution s = uzawa(problem);
    const double u = std::clamp(load / 2, -1.0, 3.0);
    EXPECT_NEAR(s.u(0), u, 1e-9) << load;
    EXPECT_NEAR(s.lambda(0), 2 * u - load, 1e-8) << load;
    EXPECT_EQ(s.active[0], std::abs(2 * u - load) > 0) << load;
  }
}

TEST(Uzawa, TheDualityGapOfOneSpringIsTheEnergyBetween) {
  // the first v is -5, with lambda = 0: J(-1) = -9, and the dual energy is J(-5) = -25
  UzawaOptions options;
  for (const double energy : {15.9, 16.1}) {
    options.stop_at = {energy, 1};
    EXPECT_EQ(uzawa(one_spring(), options).counters.contact_iterations == 0, energy > 16) << energy;
  }
  // a bound that bears no more than 3 takes up 3 * 4 on the way to -5: J(-5) = -25 + 12
  VariationalInequality soft = one_spring();
  soft.bounds.force_limit = Eigen::VectorXd{{3}};
  for (const double energy : {11.9, 12.1}) {
    options.stop_at = {energy, 1};
    EXPECT_EQ(uzawa(soft, options).counters.contact_iterations == 0, energy > 12) << energy;
  }
}

TEST(Uzawa, AsksTheCorrectionsForItsOwnToleranceButNoLessThan1em12) {
  VariationalInequality problem = one_spring();
  problem.b = RowMatrix(Eigen::MatrixXd::Ones(1, 1).sparseView());
  problem.m = Eigen::VectorXd::Ones(1);
  problem.compliance = 1e-6;
  PenalisedCholesky factor(problem, 1);
  UzawaOptions options;
  for (const double tolerance : {1e-8, 1e-12, 1e-14}) {
    double asked = 0;
    options.tolerance = tolerance;
    options.progress = [&](const Progress& progress) {
      if (progress.stage == "corrections") asked = progress.tolerance;
      return true;
    };
    uzawa(problem, factor, options);
    EXPECT_EQ(asked, std::max(tolerance, 1e-12));
  }
}

TEST(Uzawa, NeverReturnsAnUnconvergedAnswer) {
  const TriangleMesh mesh = structured_mesh(8);
  const VariationalInequality problem = stiff_problem(Space(mesh, p1()), 0.1);
  UzawaOptions options;
  options.max_iterations = 5;
  for (const auto& solve :
       {+[](const VariationalInequality&p, const UzawaOptions&o) { return uzawa(p, o); },
        +[](const VariationalInequality&p, const UzawaOptions&o) { return uzawa_cg_ilut(p, o); }}) {
    const auto error = thrown<NotConverged>([&] { solve(problem, options); });
    EXPECT_EQ(error.steps, 5);
    EXPECT_GT(error.reached, options.tolerance);
  }
  options = {};
  options.max_seconds = 0;
  EXPECT_THROW(uzawa_cg_ilut(problem, options), NotConverged);
}

TEST(Uzawa, WithoutContactIsOneLinearSolve) {
  const TriangleMesh mesh = structured_mesh(6, {0});
  const VariationalInequality problem = assemble(Scene({paper_load}), Space(mesh, p1()));
  for (const Solution& s : {uzawa(problem), uzawa_cg_ilut(problem)}) {
    EXPECT_EQ(s.counters.contact_iterations, 0) << s.solver;
    EXPECT_EQ(s.counters.solves, 1) << s.solver;
    EXPECT_LT(relative_difference(s.u, active_set(problem).u), 1e-9) << s.solver;
  }
}

TEST(Uzawa, TheLargestEigenvalueOfAnOperatorIsThatOfItsMatrix) {
  const Eigen::MatrixXd a =
      Eigen::MatrixXd::NullaryExpr(20, 20, [](Eigen::Index i, Eigen::Index j) {
        return std::exp(-0.3 * std::abs(static_cast<double>(i - j)));
      });
  for (const int size : {1, 2, 3, 20}) {
    const Eigen::MatrixXd part = a.topLeftCorner(size, size);
    const double exact_solution = symmetric_eigenvalues(part).maxCoeff();
    const double found = largest_eigenvalue(
        [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(part * x); }, size);
    EXPECT_NEAR(found, exact_solution, 1e-6 * exact_solution) << size;
    EXPECT_LE(found, exact_solution * (1 + 1e-12)) << size;  // from below
  }
}

TEST(Uzawa, FollowsThePenaltyWhereTheCorrectionsTakeASmallerOne) {
  // a penalty that is too large for a locked layer: after 15 corrections the factor is made anew,
  // and S with it
  const Space space(unstructured_mesh(8), p1());
  VariationalInequality problem = stiff_problem(space, 1e-6);
  PenalisedCholesky factor(problem, 1e-2);
  const Solution direct = active_set(problem), projected = uzawa(problem, factor);
  EXPECT_GT(projected.counters.factorisations, 1);
  EXPECT_LT((direct.u - projected.u).cwiseAbs().maxCoeff(), 1e-8 * direct.u.cwiseAbs().maxCoeff());
}

}  // namespace antilock::test::solve_test::uzawa_test
