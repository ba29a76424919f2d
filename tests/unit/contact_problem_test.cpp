// The contact problem on Gamma_C: a linear complementarity problem, solved from any start.
#include "antilock/solve/detail/dense_contact.hpp"
#include "support/dense.hpp"
#include "support/scenes.hpp"

namespace antilock::contact_problem_test {
namespace {

using namespace test;

struct Random {
  Eigen::MatrixXd s;
  Eigen::VectorXd q, lower;
  ContactAnswer solve(const Pieces& start, int max_steps = 1000) const {
    DenseContact system(s, q);
    return solve_contact(system, {lower}, start, max_steps);
  }
  Pieces nested() const { return DenseContact(s, q).nested_start({lower}, 1000); }
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
    answer.pieces.assign(n, Piece::between);
    answer.v = r.lower;
    answer.lambda = Eigen::VectorXd::Zero(n);
    for (int i = 0; i < n; ++i) {
      const bool held = (set >> i) & 1U;
      if (held) answer.pieces[i] = Piece::at_lower;
      (held ? answer.lambda(i) : answer.v(i)) += x(i);
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
    Pieces alternating(n, Piece::between);
    for (Eigen::Index i = 0; i < n; i += 2) alternating[i] = Piece::at_lower;
    for (const auto& start : {Pieces(n, Piece::between), Pieces(n, Piece::at_lower), alternating}) {
      const ContactAnswer answer = r.solve(start);
      EXPECT_EQ(answer.pieces, truth.pieces) << "seed " << seed;
      // condition of S: up to about 1e4 for these
      EXPECT_LT((answer.v - truth.v).cwiseAbs().maxCoeff(), 1e-9 * (1 + truth.v.norm())) << "seed " << seed;
      EXPECT_LT((answer.lambda - truth.lambda).cwiseAbs().maxCoeff(), 1e-9 * (1 + truth.lambda.norm()));
    }
  }
}

TEST(ContactProblem, TheConditionsHoldOnLargeProblems) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Random r = random_problem(80, seed);
    const ContactAnswer answer = r.solve(Pieces(80, Piece::between), 100000);
    const double scale = answer.lambda.maxCoeff();
    EXPECT_GE(answer.lambda.minCoeff(), -1e-12 * scale);
    EXPECT_GE((answer.v - r.lower).minCoeff(), -1e-12 * answer.v.cwiseAbs().maxCoeff());
    EXPECT_EQ(answer.lambda.cwiseProduct(answer.v - r.lower).cwiseAbs().maxCoeff(), 0);  // one of them is exactly 0
    EXPECT_LT((r.s * answer.v - r.q - answer.lambda).cwiseAbs().maxCoeff(), 1e-8 * scale);
  }
}

TEST(ContactProblem, StartingAtTheAnswerTakesOneStep) {
  const Random r = random_problem(8, 5);
  const ContactAnswer first = r.solve(Pieces(8, Piece::between), 1000);
  const ContactAnswer again = r.solve(first.pieces);
  EXPECT_GT(first.steps, 1);
  EXPECT_EQ(again.steps, 1);
  EXPECT_EQ(again.v, first.v);
}

// Below a bound that gives way, at it, between, at the upper bound, above it: v rises and lambda falls.
TEST(Stairs, ValuesRiseAndForcesFallFromPieceToPiece) {
  const Stairs stairs{Eigen::VectorXd{{0}}, Eigen::VectorXd{{1}}, Eigen::VectorXd{{3}}};
  const Pieces all{Piece::below, Piece::at_lower, Piece::between, Piece::at_upper, Piece::above};
  double v = -infinity, lambda = infinity;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto [low, high] = stairs.found(0, all[k]);
    const double given = stairs.given(0, all[k]);
    EXPECT_GE(is_held(all[k]) ? given : low, v);
    EXPECT_LE(is_held(all[k]) ? high : given, lambda);
    v = is_held(all[k]) ? given : high, lambda = is_held(all[k]) ? low : given;
    if (k > 0) {
      EXPECT_EQ(stairs.next(0, all[k], false), all[k - 1]);
      EXPECT_EQ(stairs.next(0, all[k - 1], true), all[k]);
    }
  }
  EXPECT_EQ(v, infinity);
  EXPECT_EQ(lambda, -3);
  // what a bound bears so far is left out of the forces that are given and found, and is in the whole force
  Stairs later = stairs;
  later.force = Eigen::VectorXd{{0.5}};
  for (const Piece piece : all) {
    const Stairs::Interval before = stairs.found(0, piece), now = later.found(0, piece);
    const double moved = is_held(piece) ? 0.5 : 0, given = stairs.given(0, piece);
    EXPECT_EQ(now.low, before.low - moved);
    EXPECT_EQ(now.high, before.high - moved);
    EXPECT_EQ(later.given(0, piece), given - (0.5 - moved));
    EXPECT_EQ(later.whole_force(0, piece, 0.25), is_held(piece) ? 0.75 : given);
  }
}

TEST(Stairs, AnEquationHasThreePiecesAndNothingBetween) {
  const Stairs stairs{Eigen::VectorXd{{2}}, Eigen::VectorXd{{2}}, Eigen::VectorXd{{3}}};
  EXPECT_EQ(stairs.next(0, Piece::below, true), Piece::at_lower);
  EXPECT_EQ(stairs.next(0, Piece::at_lower, true), Piece::above);
  EXPECT_EQ(stairs.next(0, Piece::above, false), Piece::at_lower);
  EXPECT_EQ(stairs.next(0, Piece::at_lower, false), Piece::below);
  EXPECT_EQ(stairs.found(0, Piece::at_lower).low, -3);
  EXPECT_EQ(stairs.found(0, Piece::at_lower).high, 3);
}

TEST(Stairs, AStartAsksForPiecesThatThereAre) {
  // two-sided, from below, from above, an equation; each bears anything, then each gives way
  const Eigen::VectorXd lower{{0, 0, -infinity, 1}}, upper{{1, infinity, 1, 1}};
  using P = Piece;
  const Stairs none{Eigen::VectorXd{{-infinity}}};  // a coarse start may ask for a bound that is not there
  for (const P asked : {P::at_lower, P::at_upper, P::above}) EXPECT_EQ(none.there_are({asked}), Pieces{P::between});
  const Stairs hard{lower, upper, {}}, soft{lower, upper, Eigen::VectorXd::Ones(4)};
  EXPECT_EQ(hard.there_are(Pieces(4, P::at_upper)), (Pieces{P::at_upper, P::at_lower, P::at_upper, P::at_lower}));
  EXPECT_EQ(hard.there_are(Pieces(4, P::at_lower)), (Pieces{P::at_lower, P::at_lower, P::at_upper, P::at_lower}));
  EXPECT_EQ(hard.there_are(Pieces(4, P::between)), (Pieces{P::between, P::between, P::between, P::at_lower}));
  EXPECT_EQ(hard.there_are(Pieces(4, P::below)), (Pieces{P::between, P::between, P::between, P::at_lower}));
  EXPECT_EQ(soft.there_are(Pieces(4, P::below)), (Pieces{P::below, P::below, P::between, P::below}));
  EXPECT_EQ(soft.there_are(Pieces(4, P::above)), (Pieces{P::above, P::between, P::above, P::above}));
  test::expect_refused([&] { hard.there_are(Pieces(3, P::between)); }, "3 pieces; accepted one per bound, 4");
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
    const ContactAnswer cold = r.solve(Pieces(n, Piece::between), 1000);
    const ContactAnswer nested = r.solve(r.nested());
    EXPECT_EQ(nested.pieces, cold.pieces) << n;
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
    const ContactAnswer nested = r.solve(r.nested());
    EXPECT_LE(nested.steps, 12) << n;
    const double start = static_cast<double>(std::find(nested.pieces.begin(), nested.pieces.end(), Piece::at_lower) -
                                             nested.pieces.begin() + 1) /
                         (n + 1);
    EXPECT_NEAR(start, 1.0 / 3, 2.0 / (n + 1)) << n;  // (72 gap / load)^(1/4)
  }
}

TEST(ContactProblem, NestedStartTakesEverySize) {
  for (int n = 1; n < 40; ++n) {
    const Random r = obstacle(n);
    const Pieces start = r.nested();
    ASSERT_EQ(static_cast<int>(start.size()), n);
    EXPECT_EQ(r.solve(start).pieces, r.solve(Pieces(n, Piece::between)).pieces);
  }
}

}  // namespace
}  // namespace antilock::contact_problem_test
