// The adversary: problems made by chance over twelve decades, each against rational arithmetic.
// `adversary` (the program) runs thousands; here is a fixed list.
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/forward_error.hpp"
#include "antilock/solve/uzawa.hpp"
#include "hard/adversary.hpp"
#include "support/scenes.hpp"
#include "support/small_problem.hpp"

namespace antilock::hard::random_against_rationals_test {

using namespace test;

/// Problems number `from` to `to` of a list by a solver, and how many of them may be refused though
/// they have an answer, or warned of though it is right: ten times the share measured over 5000
/// problems by the active set. Uzawa gives up on more, for want of more than 20,000 steps.
/// `over_claim`: how many times the error may be that of Solution::error, which is an estimate: 24
/// in the friction of seed 236. It knows nothing of what Uzawa's steps leave.
struct Sample {
  std::string name;
  VariationalInequality (*problem)(unsigned seed);
  By solver;
  unsigned from, to;
  int refused, warned;
  double over_claim = infinity;
};

class Adversary : public testing::TestWithParam<Sample> {};

TEST_P(Adversary, FindsNothingWrongInSilence) {
  const Sample& sample = GetParam();
  int solvable = 0, refused = 0, warned = 0;
  for (unsigned seed = sample.from; seed < sample.to; ++seed) {
    const VariationalInequality problem = sample.problem(seed);
    const test::ExactAnswer exact = test::exact_answer(problem);
    const Judgement judgement = judge(problem, exact, sample.solver);
    EXPECT_NE(judgement.outcome, Outcome::quietly_wrong)
        << "seed " << seed << ", error " << judgement.error;
    EXPECT_LE(judgement.over_claim, sample.over_claim)
        << "seed " << seed << ", error " << judgement.error;
    solvable += exact.what == test::Exactly::solved;
    refused += judgement.outcome == Outcome::refused;
    warned += judgement.outcome == Outcome::warned && judgement.error <= 1e-6;
  }
  EXPECT_GT(2 * solvable, static_cast<int>(sample.to - sample.from));
  EXPECT_LE(refused, sample.refused);
  EXPECT_LE(warned, sample.warned);
}

INSTANTIATE_TEST_SUITE_P(
    Lists, Adversary,
    testing::Values(Sample{"lower", random_problem, By::active_set, 0, 400, 8, 4, 10},
                    Sample{"shapes", random_bounds, By::active_set, 0, 250, 5, 4, 10},
                    Sample{"friction", random_friction, By::active_set, 0, 250, 5, 4, 30},
                    Sample{"corners", random_corner, By::active_set, 0, 400, 8, 8, 10},
                    Sample{"lower_uzawa", random_problem, By::uzawa, 0, 600, 40, 20},
                    Sample{"shapes_uzawa", random_bounds, By::uzawa, 0, 600, 60, 20},
                    Sample{"friction_uzawa", random_friction, By::uzawa, 1000, 1060, 20, 10}),
    [](const auto& sample) { return sample.param.name; });

// The lists hold what they are made for.
TEST(AdversaryLists, HaveBoundsOfEveryShape) {
  int two_sided = 0, combined = 0, slips = 0, sticks = 0;
  for (unsigned seed = 0; seed < 250; ++seed) {
    const VariationalInequality shapes = random_bounds(seed), friction = random_friction(seed);
    two_sided += shapes.bounds.has_upper_bounds();
    combined += shapes.bounds.constraints.rows() > 0;
    const test::ExactAnswer exact = test::exact_answer(friction);
    if (exact.what != test::Exactly::solved) continue;
    const Eigen::VectorXd values = bounded_values(friction.bounds, exact.u);
    for (Eigen::Index i = 0; i < values.size(); ++i)
      if (std::isfinite(friction.bounds.force_limit(i)) &&
          friction.bounds.lower(i) == friction.bounds.upper(i))
        ++(values(i) == friction.bounds.lower(i) ? sticks : slips);
  }
  EXPECT_GT(two_sided, 150);
  EXPECT_GT(combined, 80);
  EXPECT_GT(slips, 60);
  EXPECT_GT(sticks, 60);
}

/// The same problem for -u: what was a lower bound is an upper one.
VariationalInequality mirrored(VariationalInequality problem) {
  problem.load *= -1;
  problem.dirichlet_values *= -1;
  problem.bounds.upper = -problem.bounds.lower;
  problem.bounds.lower.setConstant(-infinity);
  return problem;
}

TEST(NothingInSilence, AGreatLoadOnAnUnknownInContactHidesNothing) {
  Eigen::Matrix2d a1;
  a1 << 14, 4, 4, 6;
  for (const double load : {1e8, 1e11, 1e14, 1e18, 1e25}) {
    const VariationalInequality problem =
        small_problem(a1, Eigen::Vector2d(-load, -7), Eigen::Vector2d(-0.5, -0.1));
    for (const Solution& s : {active_set(problem), uzawa(problem)})
      EXPECT_LT((s.u - problem.bounds.lower).lpNorm<Eigen::Infinity>(), 1e-9) << s.solver << load;
    VariationalInequality above = mirrored(problem);
    above.bounds.lower(0) = -1;
    for (const Solution& s : {active_set(above), uzawa(above)})
      EXPECT_LT((s.u - above.bounds.upper).lpNorm<Eigen::Infinity>(), 1e-9) << s.solver << load;
  }
}

TEST(NothingInSilence, WhatNoUCanMeetIsRefusedUnderAnyLoad) {
  // B says u_0 = 0, its bound says 0.05
  for (const double load : {1.0, 1e6, 1e12, 1e14, 1e18, 1e24})
    for (const double sign : {1.0, -1.0})
      for (const int at : {0, 1, 2}) {
        const Eigen::Vector3d force =
            sign * load * Eigen::Vector3d::Unit(at) + Eigen::Vector3d::Constant(0.1);
        VariationalInequality problem = small_problem(chain(3), force, Eigen::Vector2d(0.05, -1),
                                                      Eigen::RowVector3d(1, 0, 0), 0);
        problem.bounds.unknowns[1] = 2;
        // by the certificate: a refusal after all corrections begins otherwise
        test::expect_refused([&] { active_set(problem); }, "active set: infeasible: after");
        test::expect_refused([&] { active_set(mirrored(problem)); },
                             "active set: infeasible: after");
      }
}

// B says u_i = a_i w_i for springs of stiffness 1, the bounds u_i >= 1: w_i = 1 / a_i, reached in
// dozens of corrections. On the way no u of its size is admissible, and that is no reason to
// refuse.
TEST(NothingInSilence, AUThatMustBeGreatIsFound) {
  constexpr int rows = 9;
  Eigen::MatrixXd b = Eigen::MatrixXd::Identity(rows, 2 * rows);
  Eigen::VectorXd w(rows);
  for (int i = 0; i < rows; ++i)
    b(i, rows + i) = -1 / (w(i) = i < 8 ? std::pow(10, i / 8.0) : 1000);
  ActiveSetOptions options;
  options.penalty = 1;
  const Solution s =
      active_set(small_problem(Eigen::MatrixXd::Identity(2 * rows, 2 * rows),
                               Eigen::VectorXd::Zero(2 * rows), Eigen::VectorXd::Ones(rows), b, 0),
                 options);
  EXPECT_GT(s.counters.corrections, 15);
  EXPECT_LT((s.u.tail(rows) - w).lpNorm<Eigen::Infinity>(), 1e-10 * 1000);
}

// Corrections that shrink by `rate` each: u is off by the sum of those to come.
TEST(NothingInSilence, TheErrorIsThatOfAllCorrectionsToCome) {
  for (const double rate : {0.1, 0.5, 0.9}) {
    double to_come = 0, correction = 1e-3;
    for (int k = 0; k < 1000; ++k) to_come += correction *= rate;
    const ForwardError now =
        forward_error(small_problem(chain(3), Eigen::Vector3d::Ones()),
                      DoubleDoubleVector(Eigen::Vector3d(2, 1, 0)), rate * 1e-3, {}, rate, 0, {});
    EXPECT_NEAR(now.relative / (to_come / 2), 1, 1e-13) << rate;
  }
}

TEST(NothingInSilence, RowsThatAreNearlyDependentAreWarnedOf) {
  // B u = 0 says u_0 = u_1 and, by a second row that differs by `apart`, u_1 = 0: then u = (0, 0,
  // 1.5); else (3, 3, 3)
  for (const double apart :
       {1e-3, 1e-6, 1e-8, 1e-9, 1e-11, 1e-12, 1e-13, 4e-14, 4e-15, 1e-15, 2e-16, 0.0}) {
    Eigen::MatrixXd b(2, 3);
    b << 1, -1, 0, 1, -1 + apart, 0;
    const Solution s = active_set(small_problem(chain(3), Eigen::Vector3d(1, 2, 3), {}, b, 0));
    const double trusted = KktTolerances{}.warn;
    const bool held_apart =
        (s.u - Eigen::Vector3d(0, 0, 1.5)).lpNorm<Eigen::Infinity>() < 1.5 * trusted;
    const bool equal = (s.u - Eigen::Vector3d::Constant(3)).lpNorm<Eigen::Infinity>() < 3 * trusted;
    const bool warned = s.warning.find("nearly dependent") != std::string::npos;
    if (apart <= 1e-15)
      EXPECT_TRUE(equal && s.warning.empty()) << apart << s.warning;
    else
      EXPECT_TRUE(held_apart != warned && (warned || s.warning.empty()))
          << apart << s.u.transpose() << s.warning;
    if (apart >= 1e-8) {
      EXPECT_FALSE(warned) << apart;
    }
  }
}

// Two rows that differ where u is prescribed, by 4e-12 of it: what no step closes, 1e-12, is below
// 8 eps of u = 1,180.
TEST(NothingInSilence, AContradictionBesideAGreatUIsSeen) {
  for (const unsigned seed : {71741, 11001633})
    EXPECT_THROW(active_set(random_corner(seed)), NotConverged) << seed;
}

// A constant given on both sides is in the kernel of B, but for the rounding of B: 1 of 20 such
// scenes was refused. A floor that lifts the layer by 1e-12 of it contradicts what the mesh ties to
// the sides.
TEST(NothingInSilence, AConstantIsAdmissibleBesideGivenValuesAndNothingAboveIt) {
  TriangleMesh mesh = unstructured_mesh(8);
  for (EdgeTag& tag : mesh.edge_tag)
    if (tag == EdgeTag::clamped) tag = dirichlet_group(0);
  const Space space(mesh, p1());
  for (double u = 0.3; u < 1e5; u *= 1.7) {
    const auto solve_over = [&](double floor, double load) {
      const Field given = [=](double, double) { return u; };
      const Scene scene({[=](double x, double) { return load * std::sin(5 * x); }}, StiffLayer{0},
                        UnilateralContact{[=](double) { return -floor; }, {}},
                        {{"sides", BoundaryCondition::Kind::displacement, given}});
      return active_set(assemble(scene, space)).u.maxCoeff();
    };
    for (const double floor : {-1e3, u}) EXPECT_NEAR(solve_over(floor, 0), u, 1e-13 * u) << floor;
    EXPECT_NO_THROW(solve_over(-1e3, 1e3)) << u;
    EXPECT_THROW(solve_over(u * (1 + 1e-12), 0), NotConverged) << u;
  }
}

// As far as forward_error.hpp says: up to 200 rows. u_0 = 0, and 1e-12 u_1 is open by 1e-15.
TEST(NothingInSilence, RowsThatAreNearlyDependentAreLookedForAmongTwoHundred) {
  for (const int rows : {2, 200, 201}) {
    Eigen::MatrixXd b = Eigen::MatrixXd::Identity(rows, rows);
    b.row(1) = b.row(0);
    b(1, 1) = 1e-12;
    const double open = constraint_defect(small_problem(Eigen::MatrixXd::Identity(rows, rows),
                                                        Eigen::VectorXd::Zero(rows), {}, b, 0),
                                          1e-15 * Eigen::VectorXd::Unit(rows, 1), {})
                            .displacement;
    EXPECT_NEAR(open, rows <= 200 ? 1e-3 : 0, 1e-6)
        << rows;  // the rows are 1e-12 apart: known to eps / 1e-12
  }
}

VariationalInequality pulled_chain() {
  return small_problem(chain(3), Eigen::Vector3d(1, -2, 3), Eigen::Vector2d(-0.1, -0.1),
                       Eigen::RowVector3d(1, -1, 0.5), 0.5);
}

TEST(NothingInSilence, UnitsAreTheCallersOwn) {
  // M times s at compliance s, and A1 and the load times s at compliance 1 / s, are the same
  // problem
  const VariationalInequality one = pulled_chain();
  const Eigen::VectorXd u = active_set(one).u;
  for (const double s : {1e-9, 1e-3, 1e3, 1e9}) {
    VariationalInequality other = one;
    other.m *= s;
    other.compliance *= s;
    EXPECT_LT((active_set(other).u - u).lpNorm<Eigen::Infinity>(), 1e-9) << s;
    other = one;
    other.a1 *= s;
    other.load *= s;
    other.compliance /= s;
    EXPECT_LT((active_set(other).u - u).lpNorm<Eigen::Infinity>(), 1e-9) << s;
  }
}

// Every overload refuses what the headers say, with a factor made before as well.
TEST(NothingInSilence, AFactorMadeBeforeSkipsNoCheck) {
  const VariationalInequality good = pulled_chain();
  const auto refused = [&](const std::function<void(VariationalInequality&)>& spoil,
                           const std::string& words) {
    PenalisedCholesky factor(good);
    VariationalInequality bad = good;
    spoil(bad);
    expect_refused([&] { active_set(bad, factor); }, words);
    expect_refused([&] { uzawa(bad, factor); }, words);
    expect_refused([&] { factor.check_fits(bad); }, words);
  };
  using P = VariationalInequality;
  refused([](P& p) { p.bounds.lower.conservativeResize(1); }, "one bound per contact unknown");
  refused([](P& p) { p.bounds.lower.resize(0); }, "one bound per contact unknown");
  refused([](P& p) { p.m.resize(0); }, "M has");
  refused([](P& p) { p.load.conservativeResize(2); }, "a1 is");
  refused([](P& p) { p.compliance = -1; }, "compliance");
  refused([](P& p) { p.m(0) = -1; }, "M is not positive");
  refused([](P& p) { p.bounds.lower(1) = nan; }, "not finite");
  refused([](P& p) { p.bounds.unknowns[0] = 7; }, "out of range");
  refused([](P& p) { p.a1.coeffRef(0, 1) = 5; }, "another A1, B or M");
  refused([](P& p) { p.b.coeffRef(0, 0) = 2; }, "another A1, B or M");
  refused([](P& p) { p.m(0) = 2; }, "another A1, B or M");
  VariationalInequality skew = good;
  skew.a1.coeffRef(0, 1) = 5;
  expect_refused([&] { PenalisedCholesky{skew}; }, "not symmetric");
  for (const double delta : {0.0, -1.0, nan})
    expect_refused([&] { PenalisedCholesky(good, delta); }, "penalty");
}

TEST(NothingInSilence, TheReportPassesOverNothing) {
  const VariationalInequality problem = pulled_chain();
  const Solution right = active_set(problem);
  VariationalInequality unknown = problem;
  unknown.bounds.lower(0) = nan;
  expect_refused([&] { kkt_report(unknown, right); }, "not finite");
  Solution wrong = right;
  wrong.lambda.conservativeResize(1);
  expect_refused([&] { kkt_report(problem, wrong); }, "kkt: u, p and lambda have");
  for (const int condition : {0, 1, 2, 3}) {
    Kkt kkt = right.kkt;
    (condition == 0   ? kkt.min_gap
     : condition == 1 ? kkt.min_pressure
     : condition == 2 ? kkt.complementarity
                      : kkt.residual) = nan;
    EXPECT_EQ(worst_violation(kkt), infinity) << condition;
  }
}

}  // namespace antilock::hard::random_against_rationals_test
