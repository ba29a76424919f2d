// Bounds on many unknowns: the sparse matrix beside the Schur complement, problem by problem.
#include "antilock/solve/contact_systems.hpp"
#include "antilock/solve/sparse_cholesky.hpp"
#include "antilock/solve/uzawa.hpp"
#include "antilock/study/method.hpp"
#include "hard/adversary.hpp"
#include "support/membrane.hpp"
#include "support/scenes.hpp"

namespace antilock::test::solve_test::many_bounds_test {

/// The answer by one road, or the message of its refusal.
struct Outcome {
  Solution s;
  std::string refusal;
};

Outcome by(ContactReduction reduction, const VariationalInequality& problem) {
  try {
    ActiveSetOptions options;
    options.reduction = reduction;
    return {active_set(problem, options), ""};
  } catch (const Error& error) {
    return {{}, error.what()};
  }
}

/// The distance of two answers, relative to the largest |u|. Where u locks (it tends to 0 and keeps
/// no more digits than those of its size before) to 1e-4 of that size.
double apart(const Solution& a, const Solution& b) {
  const double distance = (a.u - b.u).lpNorm<Eigen::Infinity>();
  return distance == 0
             ? 0
             : distance / std::max(a.u.lpNorm<Eigen::Infinity>(), 1e-4 * a.penalised_max_u);
}

/// Both roads on one list of problems: how many both answer without a warning, and how many one of
/// them refuses alone, and how far apart the answers are.
struct Agreement {
  int answered = 0, other = 0, beyond = 0;  ///< beyond: further apart than 1e-10
  double furthest = 0;
};
Agreement compare(const std::function<VariationalInequality(unsigned)>& problem_of,
                  unsigned seeds) {
  Agreement agreement;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    const VariationalInequality problem = problem_of(seed);
    const Outcome dense = by(ContactReduction::schur_complement, problem),
                  sparse = by(ContactReduction::sparse, problem);
    const auto plain = [](const Outcome& o) { return o.refusal.empty() && o.s.warning.empty(); };
    agreement.other += dense.refusal.empty() != sparse.refusal.empty();
    if (!plain(dense) || !plain(sparse)) continue;
    ++agreement.answered;
    agreement.beyond += apart(dense.s, sparse.s) > 1e-10;
    agreement.furthest = std::max(agreement.furthest, apart(dense.s, sparse.s));
  }
  return agreement;
}

// Small problems of every kind: with and without B, compliance 0 to above 1, prescribed values,
// infeasible, singular.
TEST(ManyBounds, BothRoadsAgreeOnRandomProblems) {
  const Agreement agreement = compare(hard::random_problem, 1500);
  EXPECT_GT(agreement.answered, 1200);
  EXPECT_LE(agreement.furthest, 1e-10);
  EXPECT_LE(agreement.other,
            6);  // measured: 5; over 6000 10, six of them solved on the sparse matrix alone
}

TEST(ManyBounds, BothRoadsAgreeOnBoundsOfOtherShapes) {
  const Agreement agreement = compare(hard::random_bounds, 1500);
  EXPECT_GT(agreement.answered, 1000);
  EXPECT_LE(
      agreement.beyond,
      1);  // number 1063: the Schur complement is 9e-11 from the exact u, the sparse matrix 9e-10
  EXPECT_LE(agreement.furthest, 2e-9);
  EXPECT_LE(agreement.other, 10);
}

TEST(ManyBounds, BothRoadsAgreeOnBoundsThatGiveWay) {
  const Agreement agreement = compare(hard::random_friction, 600);
  EXPECT_GT(agreement.answered, 400);
  EXPECT_LE(agreement.furthest, 1e-10);
  EXPECT_LE(agreement.other, 4);
}

/// The layer problem on 8 x 8 squares with every free unknown of the layer, y <= 0, bounded from
/// below.
VariationalInequality layer_under_bounds(const TriangleMesh& mesh, const std::string& element_name,
                                         double epsilon) {
  const Space space(mesh, element(element_name));
  VariationalInequality problem = stiff_problem(space, epsilon);
  std::vector<char> fixed(problem.size(), 0);
  for (const int i : problem.dirichlet_dofs) fixed[i] = 1;
  std::vector<int> in_layer;
  for (int i = 0; i < problem.size(); ++i)
    if (fixed[i] == 0 && space.dof_coordinates()(i, 1) <= 1e-12) in_layer.push_back(i);
  problem.bounds =
      Bounds::lower_on(in_layer, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(in_layer.size())));
  return problem;
}

TEST(ManyBounds, BothRoadsAgreeOnAStiffLayerUnderBounds) {
  for (const std::string name : {"P1", "CR"})
    for (const bool structured : {true, false})
      for (const double epsilon : {1.0, 1e-3, 1e-6, 0.0}) {  // compliance 1, 1e-6, 1e-12, 0
        const TriangleMesh mesh = structured ? structured_mesh(8) : jittered_mesh(8, 0.2);
        VariationalInequality problem = layer_under_bounds(mesh, name, epsilon);
        const Eigen::VectorXd ones = Eigen::VectorXd::Ones(problem.bounds.lower.size());
        for (const double lower :
             {-10.0, -0.01, 0.0, 0.02}) {  // nowhere, in part, on the rest state, lifted
          problem.bounds.lower = lower * ones;
          const Outcome dense = by(ContactReduction::schur_complement, problem),
                        sparse = by(ContactReduction::sparse, problem);
          const std::string what =
              fmt::format("{} {} epsilon {} lower {}", name, structured, epsilon, lower);
          ASSERT_EQ(dense.refusal.empty(), sparse.refusal.empty())
              << what << dense.refusal << sparse.refusal;
          if (!dense.refusal.empty()) continue;
          EXPECT_LE(apart(dense.s, sparse.s), 1e-10) << what;
          EXPECT_EQ(dense.s.warning.empty(), sparse.s.warning.empty()) << what;
        }
      }
}

TEST(ManyBounds, BothRoadsFindTheSameDiscUnderAMembrane) {
  const VariationalInequality problem = membrane_over_obstacle(28);
  const Outcome dense = by(ContactReduction::schur_complement, problem),
                sparse = by(ContactReduction::sparse, problem);
  ASSERT_EQ(dense.refusal + sparse.refusal, "");
  EXPECT_EQ(dense.s.active, sparse.s.active);
  EXPECT_LE(apart(dense.s, sparse.s), 1e-13);
  EXPECT_LE((dense.s.lambda - sparse.s.lambda).lpNorm<Eigen::Infinity>(),
            1e-12 * dense.s.lambda.maxCoeff());
  EXPECT_EQ(dense.s.counters.factorisations, 1);
  std::vector<bool> mixed(problem.bounds.count());
  for (std::size_t i = 0; i < mixed.size(); i += 2) mixed[i] = true;
  ActiveSetOptions options;
  options.reduction = ContactReduction::sparse;
  options.start = test::held_at_lower(mixed);
  EXPECT_LE(apart(sparse.s, active_set(problem, options)), 1e-13) << "any start ends there";
}

// Between two obstacles: the membrane is pressed on the lower one on the left and on the upper one
// on the right; a few unknowns are equations, others bounded from above alone.
TEST(ManyBounds, BothRoadsAgreeBetweenTwoObstacles) {
  VariationalInequality problem = membrane_over_obstacle(28);
  problem.bounds.upper = problem.bounds.lower.array() + 0.3;
  for (int i = 0; i < problem.size(); ++i) {
    problem.load(i) *= i % 27 < 13 ? 3 : -3;
    if (i % 50 == 7) problem.bounds.upper(i) = problem.bounds.lower(i);
    if (i % 31 == 5) problem.bounds.lower(i) = -infinity;
    if (i % 31 == 6) problem.bounds.upper(i) = infinity;
  }
  const Outcome dense = by(ContactReduction::schur_complement, problem),
                sparse = by(ContactReduction::sparse, problem);
  ASSERT_EQ(dense.refusal + sparse.refusal, "");
  EXPECT_GT(dense.s.lambda.maxCoeff(), 0);
  EXPECT_LT(dense.s.lambda.minCoeff(), 0);
  EXPECT_EQ(dense.s.active, sparse.s.active);
  EXPECT_LE(apart(dense.s, sparse.s), 1e-12);
  EXPECT_LE((dense.s.lambda - sparse.s.lambda).lpNorm<Eigen::Infinity>(),
            1e-11 * dense.s.lambda.maxCoeff());
}

// All bounds hold, none does, they graze: u is the obstacle, which is its own solution.
TEST(ManyBounds, DegenerateContactIsTheSameByBothRoads) {
  VariationalInequality problem = membrane_over_obstacle(16);
  const Eigen::VectorXd grazing = problem.a1 * problem.bounds.lower;  // u = lower with no force
  for (const double push : {-1.0, 0.0, 1e-13, 1.0}) {
    problem.load = grazing + push * Eigen::VectorXd::Ones(problem.size());
    const Outcome dense = by(ContactReduction::schur_complement, problem),
                  sparse = by(ContactReduction::sparse, problem);
    ASSERT_EQ(dense.refusal + sparse.refusal, "") << push;
    EXPECT_LE(apart(dense.s, sparse.s), 1e-12) << push;
    if (push == -1) {
      EXPECT_EQ(std::count(sparse.s.active.begin(), sparse.s.active.end(), true), problem.size());
    }
  }
  problem.load.setZero();
  problem.bounds.lower.setZero();
  for (const ContactReduction reduction :
       {ContactReduction::schur_complement, ContactReduction::sparse}) {
    const Outcome rest = by(reduction, problem);
    EXPECT_TRUE(rest.s.u.isZero(0));
    EXPECT_EQ(rest.s.active, std::vector<bool>(problem.size(), false))
        << "no bound holds where nothing pushes";
    EXPECT_EQ(rest.s.counters.contact_iterations, 1);
  }
}

// From no contact and from contact everywhere the steps grow like 1/h (26 and 45 at 1/h = 128);
// nested they hardly do.
TEST(ManyBounds, TheNestedStartKeepsTheStepsFew) {
  for (const int n : {32, 64, 128}) {
    const Outcome o = by(ContactReduction::automatic, membrane_over_obstacle(n));
    ASSERT_EQ(o.refusal, "");
    EXPECT_LE(o.s.counters.contact_iterations, 9) << n;  // measured: 4, 4, 6
    if (n > 45) {  // beyond 2000 bounds the start factors smaller matrices of its own
      EXPECT_EQ(o.s.counters.factorisations, o.s.counters.contact_iterations + 1) << n;
    }
    EXPECT_EQ(o.s.warning, "");
  }
}

/// Every unknown is bounded.
BoundStatuses nested_start_of(const VariationalInequality& problem) {
  ConstrainedCholesky k;
  EXPECT_FALSE(k.factorise(SparseMatrix(problem.a1.triangularView<Eigen::Upper>())));
  return SparseContact(k, problem.load, problem.bounds.unknowns)
      .nested_start(problem.bounds.limits(), 100);
}

TEST(ManyBounds, TheNestedStartIsMostOfTheContactSetAndLittleElse) {
  const VariationalInequality problem = membrane_over_obstacle(28);
  const BoundStatuses start = nested_start_of(problem);
  const std::vector<bool> active = active_set(problem).active;
  int found = 0, contact = 0, elsewhere = 0;
  for (int i = 0; i < problem.size(); ++i) {
    contact += active[i];
    found += active[i] && is_active(start[i]);
    elsewhere += !active[i] && is_active(start[i]);
  }
  EXPECT_GE(3 * found, 2 * contact);                              // measured: 108 of 145
  EXPECT_LE(elsewhere, 5);                                        // measured: 2
  const VariationalInequality small = membrane_over_obstacle(2);  // one bound: no smaller problem
  EXPECT_EQ(nested_start_of(small), BoundStatuses(small.size(), BoundStatus::inactive));
}

// All of the membrane lies on the floor but where the floor has a hole: a start must not hold what
// no bound bears, in whatever aggregate the hole is.
TEST(ManyBounds, TheNestedStartHoldsNoBoundThatIsNotThere) {
  VariationalInequality problem = membrane_over_obstacle(28);
  for (const int hole : {0, 29}) {
    problem.bounds.lower.setZero();
    problem.bounds.lower(hole) = -infinity;
    const BoundStatuses start = nested_start_of(problem);
    EXPECT_FALSE(is_active(start[hole])) << hole;
    EXPECT_GT(std::count(start.begin(), start.end(), BoundStatus::at_lower), 700)
        << hole;  // of 729
  }
}

TEST(ManyBounds, AHeldFactorCountsTheSetsThatItFactors) {
  ConstrainedCholesky k;
  ASSERT_FALSE(
      k.factorise(SparseMatrix(membrane_over_obstacle(4).a1.triangularView<Eigen::Upper>())));
  std::vector<char> held(9, 0);
  k.constrain(held);
  EXPECT_EQ(k.factorisations(), 1);
  held[4] = 1;
  k.constrain(held);
  k.constrain(held);
  EXPECT_EQ(k.factorisations(), 2);
}

TEST(ManyBounds, OneFactorServesASweepOverLoadsBoundsAndCompliances) {
  VariationalInequality problem = layer_under_bounds(structured_mesh(8), "P1", 0.0);
  PenalisedCholesky factor(problem, 1e-4, ContactReduction::sparse);
  for (const double compliance : {0.0, 1e-12, 1e-6})
    for (const double size : {1.0, -3.0}) {
      VariationalInequality other = problem;
      other.compliance = compliance;
      other.load *= size;
      other.bounds.lower.array() -= 0.001 * std::abs(size);
      const Outcome alone = by(ContactReduction::schur_complement, other);
      ASSERT_EQ(alone.refusal, "");
      EXPECT_LE(apart(alone.s, active_set(other, factor)), 1e-10) << compliance << " " << size;
    }
}

TEST(ManyBounds, TheLibraryChoosesTheRoad) {
  EXPECT_NE(PenalisedCholesky(membrane_over_obstacle(12)).sparse_factor(),
            nullptr);  // 121 bounds, all of the unknowns
  EXPECT_EQ(PenalisedCholesky(membrane_over_obstacle(10)).sparse_factor(), nullptr);  // 81
  const TriangleMesh mesh = structured_mesh(64);  // bounds on a line
  EXPECT_EQ(PenalisedCholesky(test::stiff_problem(Space(mesh, p1()), 0.1)).sparse_factor(),
            nullptr);
}

TEST(ManyBounds, WhatIsWrongIsRefusedHereToo) {
  VariationalInequality problem = membrane_over_obstacle(28);
  PenalisedCholesky factor(problem);
  ActiveSetOptions one;
  one.max_contact_iterations = 1;
  EXPECT_THROW(active_set(problem, factor, one), NotConverged);
  expect_refused([&] { uzawa(problem, factor); },
                 "accepted: a factor made with ContactReduction::schur_complement");
  expect_refused([&] { factor.cholesky().forward(problem.load); },
                 "ContactReduction::schur_complement");
  const auto refused = [&](const auto& spoil, const std::string& words) {
    VariationalInequality bad = problem;
    spoil(bad);
    expect_refused([&] { active_set(bad, factor); }, words);
  };
  using P = VariationalInequality;
  const auto without_last = [](P& p) {
    const std::vector<int> fewer(p.bounds.unknowns.begin(), p.bounds.unknowns.end() - 1);
    p.bounds = Bounds::lower_on(fewer, p.bounds.lower.head(p.bounds.count() - 1));
  };
  refused(without_last, "free and contact unknowns");
  problem.a1.coeffRef(0, 1) = 3;
  expect_refused([&] { active_set(problem); }, "not symmetric");

  VariationalInequality floating =
      membrane_over_obstacle(28);  // each row sums to 0: held by nothing
  const Eigen::VectorXd sums = floating.a1 * Eigen::VectorXd::Ones(floating.size());
  for (int i = 0; i < floating.size(); ++i) floating.a1.coeffRef(i, i) -= sums(i);
  expect_refused([&] { active_set(floating); }, "held by nothing");

  // compliance 0 and B = I in the middle row: u = 0 there, the bound says more
  VariationalInequality infeasible = membrane_over_obstacle(28);
  infeasible.b.resize(1, infeasible.size());
  infeasible.b.insert(0, 364) = 1;
  infeasible.b.makeCompressed();
  infeasible.m = Eigen::VectorXd::Ones(1);
  infeasible.compliance = 0;
  infeasible.bounds.lower(364) = 0.05;
  EXPECT_THROW(active_set(infeasible), NotConverged);
}

}  // namespace antilock::test::solve_test::many_bounds_test
