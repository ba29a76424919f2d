// Bounds that give way: Tresca's friction, and plastic obstacles. Sticks where |lambda| < g, slips
// where |lambda| = g.
#include <numeric>

#include "antilock/measure/contact_zone.hpp"
#include "antilock/models/bar_on_a_floor.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/contact_systems.hpp"
#include "antilock/solve/uzawa.hpp"
#include "antilock/study/sweep.hpp"
#include "hard/adversary.hpp"
#include "support/brute_force.hpp"
#include "support/membrane.hpp"
#include "support/platen.hpp"
#include "support/random_contact.hpp"
#include "support/scenes.hpp"
#include "support/small_problem.hpp"

namespace antilock::test::solve_test::friction_test {

/// Up to six unknowns with a stiff row, contact, friction, plastic obstacles and combinations.
VariationalInequality random_friction(std::mt19937& engine) {
  std::normal_distribution<double> normal;
  const int n = 4 + static_cast<int>(engine() % 3), bounds = 2 + static_cast<int>(engine() % 3);
  const Eigen::MatrixXd root =
      Eigen::MatrixXd::NullaryExpr(n, n, [&](auto, auto) { return normal(engine); });
  Eigen::MatrixXd a1 = root * root.transpose();
  a1 = 0.5 * (a1 + a1.transpose().eval()) + 0.1 * Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd b =
      Eigen::MatrixXd::NullaryExpr(1, n, [&](auto, auto) { return normal(engine); });
  VariationalInequality problem = small_problem(a1, Eigen::VectorXd::Zero(n), {}, b);
  problem.compliance = std::vector{0.0, 1e-20, 1e-3, 1.0}[engine() % 4];
  problem.load = Eigen::VectorXd::NullaryExpr(n, [&](auto) { return normal(engine); });
  const int rows = n >= bounds + 2 && engine() % 2 == 0 ? 1 : 0;
  std::vector<int> unknowns(bounds);
  std::iota(unknowns.begin(), unknowns.end(), 0);
  Eigen::MatrixXd combination = Eigen::MatrixXd::Zero(rows, n);
  if (rows > 0) combination.row(0).tail(2) << 3 * normal(engine), normal(engine);
  const Eigen::VectorXd lower = Eigen::VectorXd::NullaryExpr(
      bounds + rows, [&](auto) { return -0.2 * std::abs(normal(engine)); });
  problem.bounds = {unknowns, BoundLimits(lower), RowMatrix(combination.sparseView())};
  for (int i = 0; i < bounds + rows; ++i) {
    if (engine() % 4 == 0) {  // contact, or an equation
      if (engine() % 2 == 0) problem.bounds.upper(i) = problem.bounds.lower(i);
      continue;
    }
    if (engine() % 4 == 0) continue;  // contact
    problem.bounds.force_limit(i) = 0.7 * std::abs(normal(engine));
    if (engine() % 4 == 0) continue;  // a plastic obstacle
    problem.bounds.upper(i) = problem.bounds.lower(i) =
        engine() % 3 ? 0 : 0.1;                              // friction, about 0 or elsewhere
    if (engine() % 5 == 0) problem.bounds.upper(i) += 0.05;  // with play
  }
  return problem;
}

TEST(Friction, IsRightBesideContactInHundredsOfSmallProblems) {
  std::mt19937 engine(7);
  int slips = 0, sticks = 0;
  for (int trial = 0; trial < 400; ++trial) {
    SCOPED_TRACE(trial);
    const VariationalInequality problem = random_friction(engine);
    VariationalInequality limit =
        problem;  // brute force sums A1 and B' M B / compliance: 1e-20 is 0 to all digits
    if (problem.compliance == 1e-20) limit.compliance = 0;
    const test::BruteForce exact_solution = test::brute_force(limit);
    const double size = exact_solution.u.lpNorm<Eigen::Infinity>();
    ActiveSetOptions sparse;
    sparse.reduction = ContactReduction::sparse;
    std::vector<Solution> answers{active_set(problem)};
    if (problem.bounds.constraints.rows() == 0) answers.push_back(active_set(problem, sparse));
    if (trial % 4 == 0) answers.push_back(uzawa(problem));
    for (const Solution& s : answers) {
      EXPECT_LT((s.u - exact_solution.u).lpNorm<Eigen::Infinity>(), 1e-7 * size) << s.solver;
      EXPECT_LT((s.lambda - exact_solution.lambda).lpNorm<Eigen::Infinity>(), 1e-6) << s.solver;
      EXPECT_LT(worst_violation(s.kkt), 1e-8) << s.solver;
    }
    for (Eigen::Index i = 0; i < exact_solution.lambda.size(); ++i) {
      if (std::isinf(problem.bounds.force_limit(i))) continue;
      const bool slipped =
          std::abs(exact_solution.lambda(i)) >= problem.bounds.force_limit(i) * (1 - 1e-12);
      ++(slipped ? slips : sticks);
      EXPECT_EQ(answers[0].active[i], exact_solution.active[i]) << i;
    }
  }
  EXPECT_GT(slips, 200);
  EXPECT_GT(sticks, 200);
}

TEST(Friction, ABarSlipsAsFarAsItsPullReaches) {
  std::vector<double> errors;
  for (const int n : {10, 20, 40, 80, 160}) {
    const double pull = 0.53;
    const VariationalInequality bar = bar_on_a_floor(n, pull);
    const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(n + 1, 0, 1);
    const Eigen::VectorXd exact = 0.5 * (x - 1 + pull).max(0).square();
    const Solution s = active_set(bar);
    errors.push_back((s.u - exact).lpNorm<Eigen::Infinity>());
    EXPECT_LE(errors.back(), 1.0 / (8 * n * n))
        << n;  // the end of the slip lies within a cell: h^2 / 8
    EXPECT_LT((uzawa(bar).u - s.u).lpNorm<Eigen::Infinity>(), 1e-8);
    EXPECT_NEAR(s.lambda.sum(), -pull, 1e-12);  // the floor bears all
    for (Eigen::Index i = 0; i < s.lambda.size(); ++i)
      EXPECT_EQ(s.active[i], s.lambda(i) > -bar.bounds.force_limit(i))
          << "sticks where it bears less than it can";
    EXPECT_LE(s.counters.contact_iterations, 8);
  }
}

// The pull is what one node bears, or all of them together: lambda = -g where u = 0, to the last
// bit.
TEST(Friction, ABoundThatBearsExactlyItsMostIsNoTrouble) {
  for (const int n : {2, 8, 64})
    for (const double pull : {0.5 / n, 1.5 / n, 2.5 / n, (n - 0.5) / n}) {
      const VariationalInequality bar = bar_on_a_floor(n, pull);
      std::vector<Solution> answers{active_set(bar)};
      if (pull * n > 1)
        answers.push_back(uzawa(bar));  // where all sticks u = 0: its step is never small beside u
      for (const Solution& s : answers) {
        const int slips =
            static_cast<int>(std::lround(pull * n - 0.5));  // nodes beyond the one that just sticks
        for (int i = 0; i + slips < n; ++i)
          EXPECT_NEAR(s.u(i), 0, 1e-9) << s.solver << n << ' ' << pull;
        EXPECT_LT(worst_violation(s.kkt), 1e-9);
      }
    }
}

TEST(Friction, HasTheEnergyThatNothingNearbyHas) {
  const VariationalInequality bar = bar_on_a_floor(20, 0.53);
  const Solution s = active_set(bar);
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  for (const double size : {1e-1, 1e-3, 1e-5})
    for (int trial = 0; trial < 20; ++trial) {
      Solution other = s;
      for (int i = 1; i <= 20; ++i) other.u(i) += size * normal(engine);
      EXPECT_GT(energy(bar, other), energy(bar, s));
    }
  Solution still = s;
  still.u.setZero();
  EXPECT_EQ(friction_energy(bar.bounds, still.u), 0);
  EXPECT_EQ(distance_to_bound(bar.bounds, s.u).minCoeff(),
            infinity);  // what gives way leaves every u admissible
  EXPECT_NEAR(friction_energy(bar.bounds, Eigen::VectorXd::Ones(21)), 1 - 0.5 / 20,
              1e-14);  // 21 terms
}

// g = 0 is no bound at all, g = infinity an equation, and a great g holds like one.
TEST(Friction, LimitsAreTheProblemsWithoutIt) {
  VariationalInequality bar = bar_on_a_floor(20, 0.53);
  VariationalInequality free = bar;
  free.bounds = {};
  bar.bounds.force_limit.setZero();
  for (const Solution& s : {active_set(bar), uzawa(bar)})
    EXPECT_LT((s.u - active_set(free).u).lpNorm<Eigen::Infinity>(), 1e-12) << s.solver;
  for (const double most : {1e3, 1e12, infinity}) {
    bar.bounds.force_limit.setConstant(most);
    EXPECT_EQ(active_set(bar).u.lpNorm<Eigen::Infinity>(), 0) << most;
  }
}

// Plain exchanges of whole sets cycle on some of these; the energy keeps the loop from it.
TEST(Friction, TheLoopEndsOnProblemsOnWhichExchangesCycle) {
  test::RandomContact random;
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 600; ++trial) {
    random.next();
    const int n = random.size();
    Eigen::VectorXd upper = Eigen::VectorXd::Constant(n, infinity), most = upper;
    for (int i = 0; i < n; ++i) {
      if (engine() % 3 == 0) continue;
      upper(i) = 0;
      most(i) = 0.5 * std::abs(normal(engine));
    }
    SchurComplementContact system(random.s, random.q);
    const BoundStatuses start(n, trial % 2 == 1 ? BoundStatus::at_lower : BoundStatus::inactive);
    const ContactResult answer =
        solve_contact(system, BoundLimits(random.lower, upper, most), start, 300);
    const Eigen::VectorXd residual = random.s * answer.v - random.q - answer.lambda;
    EXPECT_LT(residual.lpNorm<Eigen::Infinity>(), 1e-8) << trial;
    for (int i = 0; i < n; ++i) {
      if (std::isinf(most(i))) {
        EXPECT_TRUE(answer.v(i) >= -1e-9 && answer.lambda(i) >= -1e-9) << trial;
      } else {
        EXPECT_LE(std::abs(answer.lambda(i)), most(i) + 1e-9) << trial;
        EXPECT_NEAR(answer.lambda(i) * answer.v(i), -most(i) * std::abs(answer.v(i)),
                    1e-7 * (1 + std::abs(answer.v(i))));
      }
    }
  }
}

TEST(Friction, BothRoadsAgreeOnAMembraneThatRubs) {
  VariationalInequality membrane = test::membrane_over_obstacle(30);
  const auto count = membrane.bounds.lower.size();
  membrane.bounds.lower.setZero();  // every vertex is held in a paste that yields
  membrane.bounds.upper = membrane.bounds.lower;
  membrane.bounds.force_limit = Eigen::VectorXd::Constant(count, 4.0 / (30 * 30));
  ActiveSetOptions dense, sparse;
  dense.reduction = ContactReduction::schur_complement;
  sparse.reduction = ContactReduction::sparse;
  const Solution one = active_set(membrane, dense), other = active_set(membrane, sparse);
  EXPECT_LT((one.u - other.u).lpNorm<Eigen::Infinity>(), 1e-11);
  EXPECT_EQ(one.active, other.active);
  // half of it bears all of its load and more
  membrane.bounds.force_limit.head(count / 2).setConstant(20.0 / (30 * 30));
  const Solution held = active_set(membrane, sparse);
  EXPECT_LT((held.u - active_set(membrane, dense).u).lpNorm<Eigen::Infinity>(), 1e-11);
  EXPECT_GT(std::count(held.active.begin(), held.active.end(), true), 300);
}

TEST(Friction, TheBlockIsUniformInLambdaWhereItDoesNotLock) {
  const TriangleMesh mesh = with_free_sides(structured_mesh(16, Domain{0}));
  const Space x(mesh, p1()), y(mesh, crouzeix_raviart());
  PlaneStrain scene = platen(0, 1);
  scene.friction = [](double at) { return std::max(0.0, 0.2 - 5 * (at - 0.5) * (at - 0.5)); };
  const Solution limit = active_set(assemble(scene, {x, y}));
  for (const double epsilon : {1e-6, 1e-8, 1e-12, 1e-16, 1e-20}) {
    scene.epsilon = epsilon;
    const Solution s = active_set(assemble(scene, {x, y}));
    EXPECT_LT((s.u - limit.u).lpNorm<Eigen::Infinity>(), epsilon + 1e-12)
        << epsilon;  // measured 0.05 epsilon
    EXPECT_LE(s.counters.corrections, 5);
    EXPECT_EQ(s.active, limit.active);
  }
  scene.friction = [](double at) { return 3 * at; };
  EXPECT_NEAR(assemble(scene, {x, y}).bounds.force_limit.tail(17).sum(), 1.5, 1e-14);  // int g
  scene.friction = [](double) { return -1.0; };
  expect_refused([&] { assemble(scene, {x, y}); }, "friction bound -1");
}

TEST(Friction, ASweepOverItsBoundIsTheSameAsEachAlone) {
  Sweep sweep(bar_on_a_floor(40, 0.53));
  for (const double factor : {1.0, 0.6, 2.0, 0.0, 1.0}) {
    VariationalInequality alone = bar_on_a_floor(40, 0.53);
    alone.bounds.force_limit *= factor;
    sweep.set_force_limit(alone.bounds.force_limit);
    const Solution s = sweep.solve();
    EXPECT_LT((s.u - active_set(alone).u).lpNorm<Eigen::Infinity>(), 1e-13) << factor;
  }
  EXPECT_EQ(sweep.total().factorisations, 1);
  expect_refused([&] { sweep.set_force_limit(Eigen::VectorXd::Constant(40, -1)); },
                 "force_limit 0 is -1");
  EXPECT_LT((sweep.solve().u - active_set(bar_on_a_floor(40, 0.53)).u).lpNorm<Eigen::Infinity>(),
            1e-13)
      << "as before";
}

TEST(Friction, TheReportSeesForcesBeyondTheirBoundAndSlipTheWrongWay) {
  const VariationalInequality bar = bar_on_a_floor(20, 0.53);
  const Solution right = active_set(bar);
  EXPECT_LT(worst_violation(kkt_report(bar, right)), 1e-12);
  Solution wrong = right;
  wrong.lambda(19) *= 1.01;  // more than the floor bears
  EXPECT_LT(kkt_report(bar, wrong).min_pressure, -1e-4);
  wrong = right;
  wrong.lambda(19) *= 0.9;  // slips, and the floor bears less than it could
  EXPECT_GT(kkt_report(bar, wrong).complementarity, 1e-3);
  wrong = right;
  wrong.lambda(19) *= -1;  // slips with the force, not against it
  EXPECT_GT(kkt_report(bar, wrong).complementarity, 1e-2);
}

TEST(Friction, WhatIsMalformedOrUnknownIsRefusedInOneLine) {
  const VariationalInequality good = bar_on_a_floor(4, 0.3);
  const auto refused = [&](double value, Eigen::Index size, const std::string& words) {
    VariationalInequality bad = good;
    bad.bounds.force_limit = Eigen::VectorXd::Constant(size, value);
    for (const auto& solve : {+[](const VariationalInequality& p) { return active_set(p); },
                              +[](const VariationalInequality& p) { return uzawa(p); }})
      expect_refused([&] { solve(bad); }, words);
  };
  refused(-1, 4, "force_limit 0 is -1");
  refused(nan, 4, "force_limit 0 is nan");
  refused(1, 3, "force_limit has 3 entries; accepted 4, as in lower");
  const Space space(structured_mesh(2), p1());
  expect_refused(
      [&] {
        contact_zone({space, good, active_set(good)});
      },
      "friction is not known here");
  expect_refused([&] { require_lower_bounds(good.bounds, "certificate"); },
                 "certificate: friction is not known here");
  ActiveSetOptions options;
  options.start = BoundStatuses(3, BoundStatus::inactive);
  expect_refused([&] { active_set(good, options); }, "3 statuses; accepted one per bound, 4");
  VariationalInequality loose = good;  // nothing but friction holds it: its A1 is singular
  loose.dirichlet_dofs.clear();
  loose.dirichlet_values.resize(0);
  expect_refused([&] { active_set(loose); }, "held by nothing");
}

// Friction takes part in no infeasibility, and hides none: B u = 0 says u_0 = 0, its hard bound
// says 0.05.
TEST(Friction, AnInfeasibleProblemIsRefusedWithFrictionToo) {
  VariationalInequality problem = bar_on_a_floor(4, 0.3);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(1, 5);
  b(0, 1) = 1;
  problem.b = b.sparseView();
  problem.m = Eigen::VectorXd::Ones(1);
  problem.compliance = 0;
  problem.bounds.lower(0) = problem.bounds.upper(0) = 0.05;
  problem.bounds.force_limit(0) = infinity;
  EXPECT_THROW(active_set(problem), NotConverged);
  problem.bounds.force_limit(0) = 0.1;  // the same bound, but it gives way
  EXPECT_NEAR(active_set(problem).u(1), 0, 1e-12);
  EXPECT_NEAR(active_set(problem).lambda(0), 0.1, 1e-12);
}

}  // namespace antilock::test::solve_test::friction_test
