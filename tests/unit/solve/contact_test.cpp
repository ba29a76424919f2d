// The contact problem on Gamma_C, between two bounds: a linear complementarity problem, solved from
// any start.
#include "antilock/solve/contact_systems.hpp"
#include "support/dense.hpp"
#include "support/scenes.hpp"

namespace antilock::test::solve_test::contact_test {

struct Box {
  Eigen::MatrixXd s;
  Eigen::VectorXd q, lower, upper;
  ContactResult solve(const BoundStatuses& start, int max_iterations = 1000) const {
    SchurComplementContact system(s, q);
    return solve_contact(system, BoundLimits(lower, upper), start, max_iterations);
  }
  BoundStatuses nested() const {
    return SchurComplementContact(s, q).nested_start(BoundLimits(lower, upper), 1000);
  }
};

/// S = A A' + I / 100, dense, no M-matrix: with a `rank` of A below `size` plain active-set
/// exchanges may cycle. A third of the bounds from below alone, a sixth from above alone, a few
/// equations.
Box random_box(int size, unsigned seed, int rank = 0) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  Box box;
  const Eigen::MatrixXd a =
      Eigen::MatrixXd::NullaryExpr(size, rank > 0 ? rank : size, [&] { return normal(engine); });
  box.s = test::product(a, a.transpose()) + 1e-2 * Eigen::MatrixXd::Identity(size, size);
  box.q = Eigen::VectorXd::NullaryExpr(size, [&] { return normal(engine); });
  box.lower = Eigen::VectorXd::NullaryExpr(size, [&] { return 0.3 * normal(engine); });
  box.upper = box.lower;
  for (int i = 0; i < size; ++i) {
    const unsigned kind = engine() % 6;
    if (kind < 2) box.upper(i) = infinity;
    if (kind == 2) box.lower(i) = -infinity;
    if (kind > 2) box.upper(i) += engine() % 5 == 0 ? 0 : 0.3 * std::abs(normal(engine));
  }
  return box;
}

/// The conditions of the box, each with an absolute tolerance.
void expect_right(const Box& box, const ContactResult& answer, double tolerance) {
  const Eigen::VectorXd lambda = box.s * answer.v - box.q;
  EXPECT_LT((lambda - answer.lambda).lpNorm<Eigen::Infinity>(), tolerance);
  for (int i = 0; i < box.q.size(); ++i) {
    const bool low = answer.status[i] == BoundStatus::at_lower,
               high = answer.status[i] == BoundStatus::at_upper;
    EXPECT_GE(answer.v(i), box.lower(i) - tolerance);
    EXPECT_LE(answer.v(i), box.upper(i) + tolerance);
    EXPECT_EQ(low || high ? answer.v(i) : answer.lambda(i), low    ? box.lower(i)
                                                            : high ? box.upper(i)
                                                                   : 0);
    if (box.lower(i) == box.upper(i)) continue;  // an equation: a force of either sign
    EXPECT_GE(high ? 0 : lambda(i), -tolerance);
    EXPECT_LE(low ? 0 : lambda(i), tolerance);
  }
}

TEST(ContactProblem, EveryStartLeadsToTheOneAnswer) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const int size = 2 + static_cast<int>(seed % 6);
    const Box box = random_box(size, seed);
    Eigen::VectorXd v;
    for (int start = 0; start < std::pow(3, size); start += 7) {
      BoundStatuses status;
      for (int i = 0, digits = start; i < size; ++i, digits /= 3)
        status.push_back(static_cast<BoundStatus>(digits % 3 - 1));
      const ContactResult answer = box.solve(status);
      expect_right(box, answer, 1e-11);  // strictly convex: what meets the conditions is the answer
      if (v.size() > 0) {
        EXPECT_LT((answer.v - v).lpNorm<Eigen::Infinity>(), 1e-11) << seed;
      }
      v = answer.v;
    }
  }
}

TEST(ContactProblem, BadlyConditionedOnesDoNotCycle) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Box box = random_box(12, seed, 4);
    expect_right(box, box.solve(BoundStatuses(12, BoundStatus::inactive), 200), 1e-8);
    expect_right(box, box.solve(box.nested(), 200), 1e-8);
  }
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Box large = random_box(80, seed);
    expect_right(large, large.solve(BoundStatuses(80, BoundStatus::inactive)), 1e-8);
  }
}

TEST(ContactProblem, AWrongSideCostsAStepPerStatus) {
  Box box;
  box.s = Eigen::MatrixXd::Identity(9, 9);
  box.q = Eigen::VectorXd::Constant(9, 5);
  box.lower = Eigen::VectorXd::Constant(9, -1);
  box.upper = Eigen::VectorXd::Constant(9, 1);
  const ContactResult answer = box.solve(BoundStatuses(9, BoundStatus::at_lower), 10);
  EXPECT_EQ(answer.steps, 3);  // at_lower, between, at_upper
  EXPECT_EQ(answer.v, box.upper);
  EXPECT_EQ(answer.status, BoundStatuses(9, BoundStatus::at_upper));
  EXPECT_EQ(box.solve(answer.status, 10).steps, 1);
}

// The statuses in their order: v grows and lambda falls.
TEST(ShiftedBounds, ValuesRiseAndForcesFallFromStatusToStatus) {
  const ShiftedBounds bounds(
      BoundLimits(Eigen::VectorXd{{0}}, Eigen::VectorXd{{1}}, Eigen::VectorXd{{3}}));
  const BoundStatuses all{BoundStatus::slip_below, BoundStatus::at_lower, BoundStatus::inactive,
                          BoundStatus::at_upper, BoundStatus::slip_above};
  double v = -infinity, lambda = infinity;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto [low, high] = bounds.admissible_range(0, all[k]);
    const double given = bounds.prescribed(0, all[k]);
    EXPECT_GE(is_active(all[k]) ? given : low, v);
    EXPECT_LE(is_active(all[k]) ? high : given, lambda);
    v = is_active(all[k]) ? given : high, lambda = is_active(all[k]) ? low : given;
    if (k > 0) {
      EXPECT_EQ(bounds.next(0, all[k], false), all[k - 1]);
      EXPECT_EQ(bounds.next(0, all[k - 1], true), all[k]);
    }
  }
  EXPECT_EQ(v, infinity);
  EXPECT_EQ(lambda, -3);
  // what a bound bears so far is left out of the forces that are given and found, and is in the
  // whole force
  ShiftedBounds later = bounds;
  later.multiplier_estimate = Eigen::VectorXd{{0.5}};
  for (const BoundStatus status : all) {
    const ShiftedBounds::Interval before = bounds.admissible_range(0, status),
                                  now = later.admissible_range(0, status);
    const double moved = is_active(status) ? 0.5 : 0, given = bounds.prescribed(0, status);
    EXPECT_EQ(now.low, before.low - moved);
    EXPECT_EQ(now.high, before.high - moved);
    EXPECT_EQ(later.prescribed(0, status), given - (0.5 - moved));
    EXPECT_EQ(later.total_force(0, status, 0.25), is_active(status) ? 0.75 : given);
  }
}

TEST(ShiftedBounds, AnEquationHasThreeStatusesAndIsNeverInactive) {
  const ShiftedBounds bounds(
      BoundLimits(Eigen::VectorXd{{2}}, Eigen::VectorXd{{2}}, Eigen::VectorXd{{3}}));
  EXPECT_EQ(bounds.next(0, BoundStatus::slip_below, true), BoundStatus::at_lower);
  EXPECT_EQ(bounds.next(0, BoundStatus::at_lower, true), BoundStatus::slip_above);
  EXPECT_EQ(bounds.next(0, BoundStatus::slip_above, false), BoundStatus::at_lower);
  EXPECT_EQ(bounds.next(0, BoundStatus::at_lower, false), BoundStatus::slip_below);
  expect_refused([&] { bounds.next(0, BoundStatus::slip_above, true); }, "none beyond");
  expect_refused([&] { bounds.next(0, BoundStatus::slip_below, false); }, "none beyond");
  EXPECT_EQ(bounds.admissible_range(0, BoundStatus::at_lower).low, -3);
  EXPECT_EQ(bounds.admissible_range(0, BoundStatus::at_lower).high, 3);
}

TEST(ShiftedBounds, AStartAsksForStatusesThatExist) {
  // two-sided, from below, from above, an equation; each bears anything, then each gives way
  const Eigen::VectorXd lower{{0, 0, -infinity, 1}}, upper{{1, infinity, 1, 1}};
  using P = BoundStatus;
  // a coarse start may ask for a bound that is not there
  const ShiftedBounds none(BoundLimits(Eigen::VectorXd{{-infinity}}));
  for (const P asked : {P::at_lower, P::at_upper, P::slip_above})
    EXPECT_EQ(none.nearest_valid({asked}), BoundStatuses{P::inactive});
  const ShiftedBounds hard(BoundLimits(lower, upper)),
      soft(BoundLimits(lower, upper, Eigen::VectorXd::Ones(4)));
  EXPECT_EQ(hard.nearest_valid(BoundStatuses(4, P::at_upper)),
            (BoundStatuses{P::at_upper, P::at_lower, P::at_upper, P::at_lower}));
  EXPECT_EQ(hard.nearest_valid(BoundStatuses(4, P::at_lower)),
            (BoundStatuses{P::at_lower, P::at_lower, P::at_upper, P::at_lower}));
  EXPECT_EQ(hard.nearest_valid(BoundStatuses(4, P::inactive)),
            (BoundStatuses{P::inactive, P::inactive, P::inactive, P::at_lower}));
  EXPECT_EQ(hard.nearest_valid(BoundStatuses(4, P::slip_below)),
            (BoundStatuses{P::inactive, P::inactive, P::inactive, P::at_lower}));
  EXPECT_EQ(soft.nearest_valid(BoundStatuses(4, P::slip_below)),
            (BoundStatuses{P::slip_below, P::slip_below, P::inactive, P::slip_below}));
  EXPECT_EQ(soft.nearest_valid(BoundStatuses(4, P::slip_above)),
            (BoundStatuses{P::slip_above, P::inactive, P::slip_above, P::slip_above}));
  test::expect_refused([&] { hard.nearest_valid(BoundStatuses(3, P::inactive)); },
                       "3 statuses; accepted one per bound, 4");
}

TEST(ShiftedBounds, NeedOneEntryPerBoundInEachVector) {
  const Eigen::VectorXd two = Eigen::VectorXd::Ones(2), none;
  for (const BoundLimits& limits : {BoundLimits(two, none), BoundLimits(two, two, none)})
    test::expect_refused([&] { const ShiftedBounds bounds(limits); },
                         "accepted: one per bound in each");
  test::expect_refused([&] { const ShiftedBounds bounds(BoundLimits(two), none); },
                       "have 2, 2, 2 and 0 entries");
}

/// A 1-D obstacle problem on n points, like the limit problem on Sigma: the case where a cold start
/// takes O(n) steps.
Box obstacle(int n) {
  Box r{Eigen::MatrixXd::Zero(n, n),
        {},
        Eigen::VectorXd::Zero(n),
        Eigen::VectorXd::Constant(n, infinity)};
  const double h = 1.0 / (n + 1);
  for (int i = 0; i < n; ++i) {
    r.s(i, i) = 2 / h;
    if (i > 0) r.s(i, i - 1) = r.s(i - 1, i) = -1 / h;
  }
  r.q = Eigen::VectorXd::NullaryExpr(n, [&](Eigen::Index i) {
    return h * 10 * std::sin(2 * std::numbers::pi * static_cast<double>(i + 1) * h);
  });
  return r;
}

TEST(ContactProblem, NestedStartTakesEverySizeAndMakesTheStepsIndependentOfH) {
  std::vector<int> sizes{63, 64, 127, 255, 256};
  for (int n = 1; n < 40; ++n) sizes.push_back(n);
  for (const int n : sizes) {
    const Box r = obstacle(n);
    const ContactResult cold = r.solve(BoundStatuses(n, BoundStatus::inactive), 1000);
    const ContactResult nested = r.solve(r.nested());
    EXPECT_EQ(nested.status, cold.status) << n;
    EXPECT_LE(nested.steps, 4) << n;
    if (n > 100) {
      EXPECT_GT(cold.steps, 3 * nested.steps) << n;
    }
  }
}

}  // namespace antilock::test::solve_test::contact_test
