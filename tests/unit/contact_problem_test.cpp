// The contact problem on Gamma_C: a linear complementarity problem, solved from any start.
#include "antilock/solve/contact_problem.hpp"
#include "antilock/solve/contact_loop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "support/dense.hpp"
#include "support/scenes.hpp"

namespace antilock::contact_problem_test {
namespace {

struct Random {
  Eigen::MatrixXd s;
  Eigen::VectorXd q, lower;
  ContactProblem problem() const { return {s, q, lower, 1}; }
};

/// S = A A' + I / 100, dense, not an M-matrix. With a `rank` of A below `size` plain active-set exchanges may cycle.
Random random_problem(int size, unsigned seed, int rank = 0) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  Random r;
  const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(size, rank > 0 ? rank : size, [&] { return normal(engine); });
  r.s = test::product(a, a.transpose()) + 1e-2 * Eigen::MatrixXd::Identity(size, size);
  r.q = Eigen::VectorXd::NullaryExpr(size, [&] { return normal(engine); });
  r.lower = Eigen::VectorXd::NullaryExpr(size, [&] { return 0.3 * normal(engine); });
  return r;
}

/// The only set of 2^n that satisfies all conditions.
ContactAnswer enumerate(const Random& r) {
  const auto n = static_cast<int>(r.q.size());
  ContactAnswer answer;
  int found = 0;
  for (unsigned set = 0; set < (1U << n); ++set) {
    // unknowns of the equations: v where free, lambda where held
    Eigen::MatrixXd system = r.s;
    Eigen::VectorXd rhs = r.q - r.s * r.lower;
    for (int i = 0; i < n; ++i)
      if ((set >> i) & 1U) system.col(i) = -Eigen::VectorXd::Unit(n, i);
    const Eigen::VectorXd x = test::lu_solve(system, rhs);  // v - lower, or lambda: both must be nonnegative
    if (x.minCoeff() < -1e-12) continue;
    ++found;
    answer.active.assign(n, false);
    answer.v = r.lower;
    answer.lambda = Eigen::VectorXd::Zero(n);
    for (int i = 0; i < n; ++i) {
      answer.active[i] = (set >> i) & 1U;
      (answer.active[i] ? answer.lambda(i) : answer.v(i)) += x(i);
    }
  }
  EXPECT_EQ(found, 1);
  return answer;
}

TEST(ContactProblem, FindsTheOneAnswerFromEveryStart) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Random r = random_problem(2 + static_cast<int>(seed % 7), seed);
    const ContactAnswer truth = enumerate(r);
    const auto n = r.q.size();
    std::vector<bool> alternating(n);
    for (Eigen::Index i = 0; i < n; ++i) alternating[i] = i % 2 == 0;
    for (const auto& start : {std::vector<bool>(n, false), std::vector<bool>(n, true), alternating}) {
      const ContactAnswer answer = solve_contact(r.problem(), start, 1000);
      EXPECT_EQ(answer.active, truth.active) << "seed " << seed;
      // condition of S: up to about 1e4 for these
      EXPECT_LT((answer.v - truth.v).cwiseAbs().maxCoeff(), 1e-9 * (1 + truth.v.norm())) << "seed " << seed;
      EXPECT_LT((answer.lambda - truth.lambda).cwiseAbs().maxCoeff(), 1e-9 * (1 + truth.lambda.norm()));
    }
  }
}

TEST(ContactProblem, TheConditionsHoldOnLargeProblems) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Random r = random_problem(80, seed);
    const ContactAnswer answer = solve_contact(r.problem(), std::vector<bool>(80, false), 100000);
    const double scale = answer.lambda.maxCoeff();
    EXPECT_GE(answer.lambda.minCoeff(), -1e-12 * scale);
    EXPECT_GE((answer.v - r.lower).minCoeff(), -1e-12 * answer.v.cwiseAbs().maxCoeff());
    EXPECT_EQ(answer.lambda.cwiseProduct(answer.v - r.lower).cwiseAbs().maxCoeff(), 0);  // one of them is exactly 0
    EXPECT_LT((r.s * answer.v - r.q - answer.lambda).cwiseAbs().maxCoeff(), 1e-8 * scale);
  }
}

/// The primal-dual active set without its safeguard: every violated condition exchanged at once.
bool plain_exchanges_end(const Random& r) {
  const auto n = static_cast<int>(r.q.size());
  std::vector<bool> active(n, false);
  for (int step = 0; step < 200; ++step) {
    Eigen::MatrixXd system = r.s;
    for (int i = 0; i < n; ++i)
      if (active[i]) system.col(i) = -Eigen::VectorXd::Unit(n, i);
    const Eigen::VectorXd x = test::lu_solve(system, r.q - r.s * r.lower);
    if (x.minCoeff() >= -1e-10) return true;
    for (int i = 0; i < n; ++i)
      if (x(i) < 0) active[i] = !active[i];
  }
  return false;
}

TEST(ContactProblem, SinglePivotsEndWhatWholeSetExchangesRepeatForEver) {
  int cycles = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    const Random r = random_problem(10, seed, 6);
    if (plain_exchanges_end(r)) continue;
    ++cycles;
    const ContactAnswer answer = solve_contact(r.problem(), std::vector<bool>(10, false), 1000);
    EXPECT_GE(answer.lambda.minCoeff(), -1e-9) << seed;
    EXPECT_GE((answer.v - r.lower).minCoeff(), -1e-9) << seed;
  }
  EXPECT_GT(cycles, 0) << "no problem here needs the safeguard: the test has lost its meaning";
}

TEST(ContactProblem, StartingAtTheAnswerTakesOneStep) {
  const Random r = random_problem(8, 5);
  const ContactAnswer first = solve_contact(r.problem(), std::vector<bool>(8, false), 1000);
  const ContactAnswer again = solve_contact(r.problem(), first.active, 1000);
  EXPECT_GT(first.steps, 1);
  EXPECT_EQ(again.steps, 1);
  EXPECT_EQ(again.v, first.v);
}

TEST(ContactProblem, AllFreeAndAllHeld) {
  Random r = random_problem(6, 7);
  r.lower.setConstant(-1e6);
  EXPECT_EQ(solve_contact(r.problem(), std::vector<bool>(6, true), 1000).active, std::vector<bool>(6, false));
  r.s = Eigen::MatrixXd::Identity(6, 6);
  r.lower.setConstant(1e6);
  const ContactAnswer held = solve_contact(r.problem(), std::vector<bool>(6, false), 1000);
  EXPECT_EQ(held.active, std::vector<bool>(6, true));
  EXPECT_EQ(held.v, r.lower);
}

constexpr double infinity = std::numeric_limits<double>::infinity();
const Eigen::VectorXd none;

TEST(ContactBounds, NearestAndReachedAreTheProjectionAndItsSides) {
  // below, at the lower bound, between, at the upper bound, above; an equation; no lower bound; no upper bound
  const Eigen::VectorXd lower{{0, 0, 0, 0, 0, 1, -infinity, 0}}, upper{{1, 1, 1, 1, 1, 1, 1, infinity}};
  const ContactBounds bounds{lower, upper, none};
  const Eigen::VectorXd v{{-2, 0, 0.5, 1, 3, 7, -9, 9}};
  const Eigen::VectorXd nearest = bounds.nearest(v);
  EXPECT_EQ(nearest, (Eigen::VectorXd{{0, 0, 0.5, 1, 1, 1, -9, 9}}));
  for (const Eigen::VectorXd& at : {v, nearest}) {
    const HeldBounds held = bounds.reached(at);
    EXPECT_EQ(held.active, (std::vector<bool>{true, true, false, true, true, true, false, false}));
    EXPECT_FALSE(held.above[0] || held.above[1] || held.above[2] || held.above[6] || held.above[7]);
    EXPECT_TRUE(held.above[3] && held.above[4]);
    for (const int i : {0, 1, 3, 4}) EXPECT_EQ(bounds.at(held, i), nearest(i)) << i;
  }
  const ContactBounds floor{lower, none, none};
  EXPECT_EQ(floor.nearest(v), (Eigen::VectorXd{{0, 0, 0.5, 1, 3, 7, -9, 9}}));
  EXPECT_TRUE(floor.reached(v).above.empty());
}

TEST(ContactBounds, AStartAsksForBoundsThatThereAre) {
  // two-sided, from below, from above, an equation
  const Eigen::VectorXd lower{{0, 0, -infinity, 1}}, upper{{1, infinity, 1, 1}};
  const ContactBounds bounds{lower, upper, none};
  const HeldBounds all = bounds.allowed(HeldBounds(std::vector<bool>(4, true), std::vector<bool>(4, true)));
  EXPECT_EQ(all.active, std::vector<bool>(4, true));
  EXPECT_EQ(all.above, (std::vector<bool>{true, false, true, true}));
  const HeldBounds low = bounds.allowed(std::vector<bool>(4, true));
  EXPECT_EQ(low.above, (std::vector<bool>{false, false, true, false}));
  const HeldBounds free = bounds.allowed(std::vector<bool>(4, false));
  EXPECT_EQ(free.active, (std::vector<bool>{false, false, false, true}));
  EXPECT_EQ(free.above, std::vector<bool>(4, false));
}

TEST(ContactBounds, AnUnknownThatIsLetGoCrossesOnlyWhereItsForceTakesItAcross) {
  // one unknown, stiffness 2, bounds 0 and 1: a force of 2 moves it from one bound to the other
  const Eigen::VectorXd lower{{0}}, upper{{1}};
  const ContactBounds bounds{lower, upper, none};
  for (const bool above : {false, true})
    for (const double force : {1.9, 2.1}) {
      HeldBounds held({true}, {above});
      bounds.exchange(held, 0, above ? 1 : 0, above ? force : -force, 2);
      EXPECT_EQ(held.active[0], force > 2) << above;
      EXPECT_EQ(held.above[0], force > 2 && !above) << above;
    }
  for (const double v : {-0.5, 1.5}) {  // free, and beyond a bound: held there
    HeldBounds held({false}, {false});
    bounds.exchange(held, 0, v, 0, 2);
    EXPECT_TRUE(held.active[0]);
    EXPECT_EQ(held.above[0], v > 1);
  }
}

TEST(ContactProblem, ViolationsBelowTheRoundOffOfTheWholeProblemAreNotFollowed) {
  // v = -1e-10 under a bound of 0: a violation where the largest |u| is 1, round-off where it is 1e6 or is known to be
  const Eigen::MatrixXd s = Eigen::MatrixXd::Identity(1, 1);
  const Eigen::VectorXd q{{-1e-10}}, lower{{0}};
  EXPECT_TRUE(solve_contact({s, q, lower, 1}, std::vector<bool>{false}, 10).active[0]);
  EXPECT_FALSE(solve_contact({s, q, lower, 1e6}, std::vector<bool>{false}, 10).active[0]);
  ContactProblem known{s, q, lower, 1e6};
  known.noise = Eigen::VectorXd{{1e-12}};
  EXPECT_TRUE(solve_contact(known, std::vector<bool>{false}, 10).active[0]);
  known.noise = Eigen::VectorXd{{1e-9}};
  EXPECT_FALSE(solve_contact(known, std::vector<bool>{false}, 10).active[0]);
}

TEST(ContactProblem, TooFewStepsIsAFailureThatSaysHowFarItCame) {
  const Random r = random_problem(8, 5);
  try {
    solve_contact(r.problem(), std::vector<bool>(8, false), 1);
    FAIL() << "an unconverged answer was returned";
  } catch (const NotConverged& error) {
    EXPECT_EQ(error.steps, 1);
    EXPECT_GT(error.reached, 0);
    EXPECT_LE(error.reached, 1);
  }
}

/// A 1-D obstacle problem on n points, like the limit problem on Sigma: the case where a cold start takes O(n) steps.
Random obstacle(int n) {
  Random r;
  r.s = Eigen::MatrixXd::Zero(n, n);
  const double h = 1.0 / (n + 1);
  for (int i = 0; i < n; ++i) {
    r.s(i, i) = 2 / h;
    if (i > 0) r.s(i, i - 1) = r.s(i - 1, i) = -1 / h;
  }
  r.q = Eigen::VectorXd::NullaryExpr(
      n, [&](Eigen::Index i) { return h * 10 * std::sin(2 * std::numbers::pi * static_cast<double>(i + 1) * h); });
  r.lower = Eigen::VectorXd::Zero(n);
  return r;
}

TEST(ContactProblem, NestedStartMakesTheStepsIndependentOfH) {
  for (const int n : {15, 31, 63, 64, 127, 255, 256}) {
    const Random r = obstacle(n);
    const ContactAnswer cold = solve_contact(r.problem(), std::vector<bool>(n, false), 1000);
    const ContactAnswer nested = solve_contact(r.problem(), nested_start(r.problem(), 1000), 1000);
    EXPECT_EQ(nested.active, cold.active) << n;
    EXPECT_LE(nested.steps, 4) << n;
    if (n > 100) {
      EXPECT_GT(cold.steps, 3 * nested.steps) << n;
    }
  }
}

/// A clamped beam over an obstacle: S of fourth order, condition number n^4, forces concentrated at the ends of
/// contact.
Random beam(int n) {
  Random r;
  const double h = 1.0 / (n + 1);
  Eigen::MatrixXd second = Eigen::MatrixXd::Zero(n + 2, n);  // second differences, the clamps by reflection
  for (int i = 0; i < n; ++i) {
    second(i + 1, i) = -2;
    if (i > 0) second(i, i) = 1;
    if (i + 1 < n) second(i + 2, i) = 1;
  }
  second(0, 0) = second(n + 1, n - 1) = std::sqrt(2.0);  // half a cell each
  r.s = test::product(second.transpose(), second) / (h * h * h);
  r.q = Eigen::VectorXd::Constant(n, -5832 * h);
  r.lower = Eigen::VectorXd::Constant(n, -1);
  return r;
}

TEST(ContactProblem, NestedStartServesABeamToo) {
  for (const int n : {31, 63, 127, 255}) {
    const Random r = beam(n);
    const ContactAnswer nested = solve_contact(r.problem(), nested_start(r.problem(), 1000), 1000);
    EXPECT_LE(nested.steps, 12) << n;
    const double start = nested.active.empty()
                             ? 0
                             : static_cast<double>(std::find(nested.active.begin(), nested.active.end(), true) -
                                                   nested.active.begin() + 1) /
                                   (n + 1);
    EXPECT_NEAR(start, 1.0 / 3, 2.0 / (n + 1)) << n;  // (72 gap / load)^(1/4)
  }
}

TEST(ContactProblem, NestedStartTakesEverySize) {
  for (int n = 1; n < 40; ++n) {
    const Random r = obstacle(n);
    const std::vector<bool> start = nested_start(r.problem(), 1000).active;
    ASSERT_EQ(static_cast<int>(start.size()), n);
    EXPECT_EQ(solve_contact(r.problem(), start, 1000).active,
              solve_contact(r.problem(), std::vector<bool>(n, false), 1000).active);
  }
}

}  // namespace
}  // namespace antilock::contact_problem_test
