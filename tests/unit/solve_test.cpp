#include <Eigen/Geometry>
#include <Eigen/LU>

#include "../../tutorials/book/wasm/host/eigen_cholesky.cpp"
#include "antilock/analysis/accurate_enough.hpp"
#include "antilock/analysis/certificate.hpp"
#include "antilock/core/dense.hpp"
#include "antilock/core/eigenvalues.hpp"
#include "antilock/exact/truth_table.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/solve/detail/anderson.hpp"
#include "antilock/solve/detail/contact_systems.hpp"
#include "antilock/solve/detail/penalised_matrix.hpp"
#include "antilock/solve/detail/sparse_cholesky.hpp"
#include "antilock/solve/residual.hpp"
#include "antilock/solve/uzawa.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/sweep.hpp"
#include "backstage/18_summed.hpp"
#include "backstage/30_bar.hpp"
#include "hard/adversary.hpp"
#include "support/brute_force.hpp"
#include "support/dense.hpp"
#include "support/exact_rational.hpp"
#include "support/membrane.hpp"
#include "support/platen.hpp"
#include "support/random_contact.hpp"
#include "support/scenes.hpp"
#include "support/small_problem.hpp"

namespace antilock::test::solve_test {

using namespace tutorial;

// ==== The contact problem on Gamma_C, between two bounds: a linear complementarity problem, solved from any start.

struct Box {
  Eigen::MatrixXd s;
  Eigen::VectorXd q, lower, upper;
  ContactAnswer solve(const Pieces& start, int max_steps = 1000) const {
    DenseContact system(s, q);
    return solve_contact(system, {lower, upper}, start, max_steps);
  }
  Pieces nested() const { return DenseContact(s, q).nested_start({lower, upper}, 1000); }
};

/// S = A A' + I / 100, dense, no M-matrix: with a `rank` of A below `size` plain active-set exchanges may cycle. A third of
/// the bounds from below alone, a sixth from above alone, a few equations.
Box random_box(int size, unsigned seed, int rank = 0) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  Box box;
  const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(size, rank > 0 ? rank : size, [&] { return normal(engine); });
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
void expect_right(const Box& box, const ContactAnswer& answer, double tolerance) {
  const Eigen::VectorXd lambda = box.s * answer.v - box.q;
  EXPECT_LT((lambda - answer.lambda).lpNorm<Eigen::Infinity>(), tolerance);
  for (int i = 0; i < box.q.size(); ++i) {
    const bool low = answer.pieces[i] == Piece::at_lower, high = answer.pieces[i] == Piece::at_upper;
    EXPECT_GE(answer.v(i), box.lower(i) - tolerance);
    EXPECT_LE(answer.v(i), box.upper(i) + tolerance);
    EXPECT_EQ(low || high ? answer.v(i) : answer.lambda(i), low ? box.lower(i) : high ? box.upper(i) : 0);
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
      Pieces pieces;
      for (int i = 0, digits = start; i < size; ++i, digits /= 3) pieces.push_back(static_cast<Piece>(digits % 3 - 1));
      const ContactAnswer answer = box.solve(pieces);
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
    expect_right(box, box.solve(Pieces(12, Piece::between), 200), 1e-8);
    expect_right(box, box.solve(box.nested(), 200), 1e-8);
  }
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Box large = random_box(80, seed);
    expect_right(large, large.solve(Pieces(80, Piece::between)), 1e-8);
  }
}

TEST(ContactProblem, AWrongSideCostsAStepPerPiece) {
  Box box;
  box.s = Eigen::MatrixXd::Identity(9, 9);
  box.q = Eigen::VectorXd::Constant(9, 5);
  box.lower = Eigen::VectorXd::Constant(9, -1);
  box.upper = Eigen::VectorXd::Constant(9, 1);
  const ContactAnswer answer = box.solve(Pieces(9, Piece::at_lower), 10);
  EXPECT_EQ(answer.steps, 3);  // at_lower, between, at_upper
  EXPECT_EQ(answer.v, box.upper);
  EXPECT_EQ(answer.pieces, Pieces(9, Piece::at_upper));
  EXPECT_EQ(box.solve(answer.pieces, 10).steps, 1);
}

// Below a bound that gives way, at it, between, at the upper bound, above it: v rises and lambda falls.
TEST(Stairs, ValuesRiseAndForcesFallFromPieceToPiece) {
  const Stairs stairs{Eigen::VectorXd{{0}}, Eigen::VectorXd{{1}}, Eigen::VectorXd{{3}}};
  const Pieces all{Piece::below, Piece::at_lower, Piece::between, Piece::at_upper, Piece::above};
  double v = -infinity, lambda = infinity;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto [low, high] = stairs.found(0, all[k]);
    const double given = stairs.given(0, all[k]);
    EXPECT_GE(is_active(all[k]) ? given : low, v);
    EXPECT_LE(is_active(all[k]) ? high : given, lambda);
    v = is_active(all[k]) ? given : high, lambda = is_active(all[k]) ? low : given;
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
    const double moved = is_active(piece) ? 0.5 : 0, given = stairs.given(0, piece);
    EXPECT_EQ(now.low, before.low - moved);
    EXPECT_EQ(now.high, before.high - moved);
    EXPECT_EQ(later.given(0, piece), given - (0.5 - moved));
    EXPECT_EQ(later.whole_force(0, piece, 0.25), is_active(piece) ? 0.75 : given);
  }
}

TEST(Stairs, AnEquationHasThreePiecesAndNothingBetween) {
  const Stairs stairs{Eigen::VectorXd{{2}}, Eigen::VectorXd{{2}}, Eigen::VectorXd{{3}}};
  EXPECT_EQ(stairs.next(0, Piece::below, true), Piece::at_lower);
  EXPECT_EQ(stairs.next(0, Piece::at_lower, true), Piece::above);
  EXPECT_EQ(stairs.next(0, Piece::above, false), Piece::at_lower);
  EXPECT_EQ(stairs.next(0, Piece::at_lower, false), Piece::below);
  expect_refused([&] { stairs.next(0, Piece::above, true); }, "none beyond");
  expect_refused([&] { stairs.next(0, Piece::below, false); }, "none beyond");
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
Box obstacle(int n) {
  Box r{Eigen::MatrixXd::Zero(n, n), {}, Eigen::VectorXd::Zero(n), {}};
  const double h = 1.0 / (n + 1);
  for (int i = 0; i < n; ++i) {
    r.s(i, i) = 2 / h;
    if (i > 0) r.s(i, i - 1) = r.s(i - 1, i) = -1 / h;
  }
  r.q = Eigen::VectorXd::NullaryExpr(
      n, [&](Eigen::Index i) { return h * 10 * std::sin(2 * std::numbers::pi * static_cast<double>(i + 1) * h); });
  return r;
}

TEST(ContactProblem, NestedStartTakesEverySizeAndMakesTheStepsIndependentOfH) {
  std::vector<int> sizes{63, 64, 127, 255, 256};
  for (int n = 1; n < 40; ++n) sizes.push_back(n);
  for (const int n : sizes) {
    const Box r = obstacle(n);
    const ContactAnswer cold = r.solve(Pieces(n, Piece::between), 1000);
    const ContactAnswer nested = r.solve(r.nested());
    EXPECT_EQ(nested.pieces, cold.pieces) << n;
    EXPECT_LE(nested.steps, 4) << n;
    if (n > 100) {
      EXPECT_GT(cold.steps, 3 * nested.steps) << n;
    }
  }
}

// ==== Two factors behind one interface: what each promises, and that both give the same answers over the uniformity table.

/// The upper triangle of two tridiagonal matrices (2 on the diagonal, -1 beside it; `size` rows each) that share nothing.
/// Where it `floats`, the second has 1 at both ends of its diagonal: it is held at neither, and singular.
SparseMatrix two_strings(int size, bool floats) {
  SparseMatrix k(2 * size, 2 * size);
  for (int i = 0; i < 2 * size; ++i) {
    const bool end = i == size || i == 2 * size - 1;
    k.insert(i, i) = floats && end ? 1 : 2;
    if (i > 0 && i != size) k.insert(i - 1, i) = -1;
  }
  k.makeCompressed();
  return k;
}

class CholeskyOf : public testing::TestWithParam<CholeskyMaker> {};
INSTANTIATE_TEST_SUITE_P(BothFactors, CholeskyOf, testing::Values(default_cholesky, eigen_cholesky));

TEST_P(CholeskyOf, SolvesAndLeavesTheLastRowsLast) {
  const SpaceOn space(unstructured_mesh(8), crouzeix_raviart());
  const VariationalInequality problem = stiff_problem(space, 0.1);
  const FreeNumbering free(problem);
  SparseMatrix k = penalised_matrix(problem, free, 1e-3);
  const Eigen::MatrixXd full = Eigen::MatrixXd(k).selfadjointView<Eigen::Upper>();
  const int size = static_cast<int>(k.cols());
  const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(size, -1, 2), x = Cholesky(full).solve(r);
  const Eigen::VectorXd eigenvalues = symmetric_eigenvalues(full);
  const double round_off = 1e-16 * eigenvalues(size - 1) / eigenvalues(0);  // of x, to first order
  for (const int last : {0, size - free.interior, size}) {
    const auto factor = GetParam()();
    factor->analyse(k, last);
    ASSERT_FALSE(factor->factorise(k));
    EXPECT_LT(relative_difference(factor->backward(factor->forward(r)), x), round_off) << last;
    // L L' of the last rows is their Schur complement
    const Eigen::MatrixXd l = factor->trailing_block(size - last),
                          inside = full.topLeftCorner(size - last, size - last),
                          beside = full.topRightCorner(size - last, last);
    Eigen::MatrixXd schur = full.bottomRightCorner(last, last);
    if (last < size) schur -= test::product(beside.transpose(), Cholesky(inside).solve(beside));
    if (last == 0) continue;
    EXPECT_LT((test::product(l, l.transpose()) - schur).cwiseAbs().maxCoeff(), 1e-12 * full.cwiseAbs().maxCoeff());
  }
}

// 64 rows: the pivot that is lost is 0 or a few times the round-off of 2; the sign that it comes with is chance.
TEST_P(CholeskyOf, NamesARowOfThePieceThatFloatsAndRecovers) {
  for (const int last : {0, 3}) {
    const auto factor = GetParam()();
    SparseMatrix sound = two_strings(64, false), floating = two_strings(64, true), negative = sound;
    negative.coeffRef(70, 70) = -1;
    factor->analyse(sound, last);
    for (SparseMatrix* k : {&floating, &sound, &negative, &sound}) {
      const std::optional<int> lost = factor->factorise(*k);
      EXPECT_EQ(lost.has_value(), k != &sound);
      EXPECT_GE(lost.value_or(64), 64) << "the first piece is sound";
    }
    const Eigen::VectorXd r = Eigen::VectorXd::Ones(128), x = factor->backward(factor->forward(r));
    // backward stable: a small multiple of eps |K| |x|, and |K| < 4; measured 0.06 times 4 of these
    EXPECT_LT((sound.selfadjointView<Eigen::Upper>() * x - r).norm(),
              4 * std::numeric_limits<double>::epsilon() * 4 * x.norm());
  }
}

TEST_P(CholeskyOf, SmallestPivotIsThatOfTheElimination) {
  SparseMatrix k(3, 3);
  for (const int i : {0, 1, 2}) k.insert(i, i) = std::pow(10, -i);
  k.makeCompressed();
  const auto factor = GetParam()();
  factor->analyse(k, 0);
  ASSERT_FALSE(factor->factorise(k));
  EXPECT_NEAR(factor->smallest_pivot(), 1e-2, 1e-15);
}

constexpr double every_epsilon[]{1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-16, 1e-20, 0.0};

// The answers of 12 epsilons, 2 elements, 2 meshes and 2 values of 1/h. The tolerance of the corrections is 1e-10; two
// factors of the same K take the same ones, and so stand much closer to each other than to the solution.
TEST(TwoFactors, BothFactorsGiveTheSameAnswersOverTheUniformityTable) {
  double worst = 0;
  int answers = 0;
  for (const int cells : {16, 64})
    for (const Method& method : methods()) {
      const Discretisation discrete = method.on(cells);
      for (const double epsilon : every_epsilon) {
        SCOPED_TRACE(fmt::format("{}, 1/h = {}, epsilon = {}", method.name(), cells, epsilon));
        const VariationalInequality problem = stiff_problem(discrete.space(), epsilon);
        PenaltyFactor cholmod(problem, {}, ContactRoad::automatic, default_cholesky);
        PenaltyFactor eigen(problem, {}, ContactRoad::automatic, eigen_cholesky);
        const Solution one = active_set(problem, cholmod), other = active_set(problem, eigen);
        const double apart = relative_difference(other.u, one.u);
        EXPECT_LT(apart, 1e-12);
        EXPECT_LT(std::abs(eigen.smallest_pivot() / cholmod.smallest_pivot() - 1), 0.9)
            << "pivots of the same K, in another order";
        worst = std::max(worst, apart);
        ++answers;
      }
    }
  EXPECT_EQ(answers, 96);
  fmt::print("{} answers, largest difference {:.1e} (relative, largest entry)\n", answers, worst);
}

// The road on which unknowns are held, and factors are made anew for every set of them.
TEST(TwoFactors, BothFactorsGiveTheSameAnswersOnTheSparseRoad) {
  for (const Method& method : methods()) {
    const Discretisation discrete = method.on(16);
    for (const double epsilon : {1.0, 1e-4, 0.0}) {
      const VariationalInequality problem = stiff_problem(discrete.space(), epsilon);
      PenaltyFactor cholmod(problem, {}, ContactRoad::sparse, default_cholesky);
      PenaltyFactor eigen(problem, {}, ContactRoad::sparse, eigen_cholesky);
      EXPECT_NE(eigen.held(), nullptr);
      EXPECT_LT(relative_difference(active_set(problem, eigen).u, active_set(problem, cholmod).u), 1e-12)
          << method.name();
    }
  }
}

// ==== The active set with its iterated penalty: one answer, the right one, whatever the scale, the numbering and epsilon.

/// Obstacles: touching, below, pressing in, and one that presses in on the left only.
std::vector<UnilateralContact> obstacles() {
  return {{[](double) { return 0.0; }},
          {[](double) { return 0.02; }},
          {[](double x) { return -0.05 * std::sin(std::numbers::pi * x); }},
          {[](double x) { return x * (x - 0.4) * (1 - x); }}};
}

TEST(ActiveSet, IsTheBruteForceAnswer) {
  for (const SpaceOn& space : two_square_spaces(4, {&p1(), &crouzeix_raviart()})) {
    for (const double epsilon : {1.0, 0.1, 1e-2, 1e-4, 0.0}) {
      if (epsilon == 0 && &space.element() == &p1() && space.name.starts_with("unstructured"))
        continue;  // locked: lambda is not unique
      for (std::size_t k = 0; k < obstacles().size(); ++k) {
        SCOPED_TRACE(space.name + ", epsilon " + std::to_string(epsilon) + ", obstacle " + std::to_string(k));
        const VariationalInequality problem = stiff_problem(space, epsilon, obstacles()[k]);
        const test::BruteForce truth = test::brute_force(problem);
        const Solution solution = active_set(problem);
        // corrections stop at an estimated 1e-10
        EXPECT_LT(relative_difference(solution.u, truth.u), 1e-9);
        EXPECT_LT((solution.lambda - truth.lambda).cwiseAbs().maxCoeff(),
                  1e-8 * (problem.load.cwiseAbs().maxCoeff() + truth.lambda.cwiseAbs().maxCoeff()));
        EXPECT_EQ(solution.active, truth.active);
        if (epsilon > 0) {
          const Eigen::VectorXd p = problem.b * truth.u / problem.compliance;
          // digits of B u that epsilon^-2 leaves in double precision
          EXPECT_LT(relative_difference(solution.p, p), 1e-8 + 1e-15 / problem.compliance);
        }
      }
    }
  }
}

TEST(ActiveSet, LimitProblemOnAStructuredMeshIsVentcels) {
  // at epsilon = 0 the layer's u is constant along y, and its energy is the Ventcel term: (24) is (25), also discretely
  const TriangleMesh both = structured_mesh(12), body = structured_mesh(12, {0});
  for (const Element* element : {&p1(), &crouzeix_raviart()})
    for (const UnilateralContact& obstacle : obstacles()) {
      const Space on_both(both, *element), on_body(body, *element);
      const VariationalInequality in_layer = stiff_problem(on_both, 0, obstacle),
                                  on_line = assemble(Scene({paper_load}, VentcelLayer{}, obstacle), on_body);
      const Solution limit = active_set(in_layer), ventcel = active_set(on_line);
      EXPECT_LT(relative_difference(limit.u(on_both.contact()), ventcel.u(on_body.contact())), 1e-8);
      EXPECT_NEAR(energy(in_layer, limit), energy(on_line, ventcel), 1e-9);
      EXPECT_LT(relative_difference(limit.lambda, ventcel.lambda), 1e-8);
      EXPECT_EQ(limit.active, ventcel.active);
    }
}

TEST(ActiveSet, TendsToTheLimitLikeEpsilonSquared) {
  const SpaceOn space(unstructured_mesh(8), crouzeix_raviart());
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
          if (cells == 128 && epsilon != 1e-1 && epsilon != 0) continue;  // the two hardest, for the sake of time
          const Counters c = active_set(stiff_problem(space, epsilon)).counters;
          const std::string where = element->name() + (structured ? "" : " unstructured") +
                                    ", 1/h = " + std::to_string(cells) + ", epsilon = " + std::to_string(epsilon);
          EXPECT_LE(c.contact, 4) << where;
          EXPECT_GE(c.contact, 1) << where;
          EXPECT_LE(c.corrections, 10) << where;
          EXPECT_EQ(c.factorisations, 1) << where;
        }
      }
    }
}

TEST(ActiveSet, NeverReturnsAnUnconvergedAnswer) {
  const SpaceOn space(unstructured_mesh(8), crouzeix_raviart());
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
  options.max_steps = 1;
  options.start = Pieces(problem.contact.size(), Piece::at_lower);
  EXPECT_THROW(active_set(problem, options), NotConverged);
  options.start->push_back(Piece::between);
  expect_refused([&] { active_set(problem, options); }, "contact: the start has");
}

// x -> x + g(x) contracts by 0.9 in one unknown and by 0.1 in the others. A mix makes g fall faster than the plain steps
// do, and an error estimate made of that would stop ten times too early.
TEST(Anderson, TheContractionIsThatOfThePlainSteps) {
  const Eigen::VectorXd rate = Eigen::Vector4d(0.9, 0.1, 0.08, 0.05), fixed_point = Eigen::Vector4d(1, 1, -2, 3);
  Anderson anderson;
  Twice x(Eigen::VectorXd::Zero(4)), companion = x;
  double before = 1;
  for (int step = 0; step < 5; ++step) {
    const Eigen::VectorXd g = (1 - rate.array()) * (fixed_point - x.high).array();
    x += g;
    companion += g;
    anderson.note(x, g, companion);
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

// Locked P1 under a penalty a hundred times too large: corrections contract by 0.9, and the answer is still right.
TEST(ActiveSet, SlowCorrectionsDoNotStopEarly) {
  const TriangleMesh mesh = unstructured_mesh(8);
  const VariationalInequality problem = stiff_problem(Space(mesh, p1()), 1e-6);
  const Solution right = active_set(problem);
  for (const double penalty : {1e-3, 5e-3, 2e-2}) {
    ActiveSetOptions options;
    options.penalty = penalty;
    const Solution slow = active_set(problem, options);
    EXPECT_GT(slow.counters.corrections, right.counters.corrections) << penalty;
    EXPECT_LT(relative_difference(slow.u, right.u), 3e-10) << penalty;  // twice the tolerance, and |u| < |u before|
  }
}

TEST(PenaltyFactor, ForwardAndBackwardSolveWithK) {
  const SpaceOn space(unstructured_mesh(6), crouzeix_raviart());
  const VariationalInequality problem = stiff_problem(space, 0.1);
  PenaltyFactor factor(problem, 0.01);
  EXPECT_EQ(PenaltyFactor(problem).delta(), problem.compliance);  // 0.01, above h^2 / 16
  for (const double delta : {0.01, 1e-4}) {
    factor.refactor(delta);
    EXPECT_EQ(factor.delta(), delta);
    const std::vector<int>& unknown = factor.numbering().unknown;
    const Eigen::MatrixXd k = Eigen::MatrixXd(problem.a1) + test::gram(problem.b, problem.m) / delta;
    const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(problem.free_count(), -1, 2);
    const Eigen::VectorXd x = factor.dense().backward(factor.dense().forward(r));
    const Eigen::VectorXd truth = Cholesky(k(unknown, unknown)).solve(r);
    EXPECT_LT(relative_difference(x, truth), 1e-10) << delta;
  }
  EXPECT_EQ(factor.factorisations(), 3);
}

// A harder question moves its delta, and one too small for its digits is raised; each question has the answer of its own.
TEST(PenaltyFactor, ServesEveryComplianceAndEveryDeltaAskedFor) {
  VariationalInequality graded = small_problem(Eigen::Vector3d(1, 1e-8, 1e-8).asDiagonal(), Eigen::Vector3d(1, 1e-8, 0),
                                               Eigen::VectorXd(), Eigen::Matrix<double, 2, 3>{{1, 0, 0}, {0, 1, 1}});
  PenaltyFactor factor(graded, 1);
  Sweep sweep(graded);
  for (const double c : {1.0, 0.0, 1.0, 0.0}) {  // u_1 = 1 / (1 + 1 / c), u_2 - u_3 = 1, u_2 + u_3 = 1 / (1 + 2e8 / c)
    graded.compliance = c;
    sweep.set_compliance(c);
    const double sum = c / (c + 2e8);
    for (const Solution& s : {active_set(graded, factor), sweep.solve(), sweep.solve()})
      EXPECT_LT((s.u - Eigen::Vector3d(c / (c + 1), (sum + 1) / 2, (sum - 1) / 2)).norm(), 1e-9) << c;
  }
}

TEST(ActiveSet, EndsWhereNumbersOverflowAndRefusesATolerance0) {
  VariationalInequality problem =
      small_problem(Eigen::Matrix2d{{1, -0.99}, {-0.99, 1}}, Eigen::Vector2d(1e307, 1e307), Eigen::Vector2d(0, 0));
  problem.upper = Eigen::Vector2d(1, 2);
  EXPECT_EQ(active_set(problem).u, problem.upper);
  ActiveSetOptions options;
  options.corrections.tolerance = 0;
  EXPECT_THROW(active_set(problem, options), Error);
}

TEST(Combinations, LeaveTiedRowsTied) {
  VariationalInequality problem =
      small_problem(Eigen::Matrix2d{{2, -1}, {-1, 2}}, Eigen::Vector2d(1, 0.5), {}, Eigen::RowVector2d(1, 1), 1e-3);
  problem.own_compliances = Eigen::VectorXd::Zero(1);
  problem.combinations = RowMatrix(Eigen::MatrixXd(Eigen::RowVector2d(1, -3)).sparseView());
  problem.lower = Eigen::VectorXd::Constant(1, -10);
  EXPECT_NEAR(active_set(problem).u.sum(), 0, 1e-15);
}

TEST(Progress, IsReportedOncePerCorrectionAndStopsTheSolve) {
  const SpaceOn space(structured_mesh(8), p1());
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
  ASSERT_EQ(static_cast<int>(seen.size()), followed.counters.corrections);  // the last one is the answer
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].step, static_cast<int>(i) + 1);
    EXPECT_EQ(seen[i].asked, options.corrections.tolerance);
  }
  options.corrections.progress = [](const Progress& now) { return now.step < 2; };
  const auto stopped = thrown<Stopped>([&] { active_set(problem, options); });
  EXPECT_EQ(stopped.steps, 2);
  EXPECT_NE(std::string(stopped.what()).find("stopped as asked"), std::string::npos) << stopped.what();
}

TEST(Progress, StopsUzawaAmongItsSteps) {
  const SpaceOn space(structured_mesh(16), p1());
  const VariationalInequality problem = test::stiff_problem(space, 0.1);
  UzawaOptions options;
  options.step = 1e-3;  // far too short: thousands of steps
  options.progress = [](const Progress& now) { return now.stage != "contact"; };
  EXPECT_EQ(thrown<Stopped>([&] { uzawa(problem, options); }).steps, 32);
}

// ==== The report that stands between a solver and its caller: relative, scale-free, and merciless.

/// A solved problem of Figure 5 on a small mesh, with contact on part of Gamma_C.
struct Solved {
  explicit Solved(double epsilon)
      : mesh(unstructured_mesh(8)),
        space(mesh, crouzeix_raviart()),
        problem(stiff_problem(space, epsilon, {[](double) { return 1e-4; }})),
        solution(active_set(problem)) {}
  TriangleMesh mesh;
  Space space;
  VariationalInequality problem;
  Solution solution;
};

int held(const Solution& s) {
  return static_cast<int>(std::find(s.active.begin(), s.active.end(), true) - s.active.begin());
}
int loose(const Solution& s) {
  return static_cast<int>(std::find(s.active.begin(), s.active.end(), false) - s.active.begin());
}

TEST(Kkt, SplitResidualIsZeroOfTheSolutionAndTheReactionOnTheClamps) {
  const Solved s(1e-3);
  const SplitResidual r = exact_residual(s.problem, s.solution.u, s.solution.p, s.solution.lambda);
  Eigen::VectorXd free = r.r1;
  free(s.problem.fixed).setZero();
  EXPECT_LT(free.cwiseAbs().maxCoeff(), 1e-9 * s.problem.load.cwiseAbs().maxCoeff() * 100);
  EXPECT_GT(Eigen::VectorXd(r.r1(s.problem.fixed)).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT(r.r2.cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Kkt, APullIsMeasuredByTheLargestForce) {
  const Solved s(0.1);
  Solution wrong = s.solution;
  const double largest = std::max(s.problem.load.cwiseAbs().maxCoeff(), s.solution.lambda.cwiseAbs().maxCoeff());
  wrong.lambda(held(s.solution)) = -0.1 * largest;
  EXPECT_NEAR(kkt_report(s.problem, wrong).min_pressure, -0.1, 1e-12);
}

// A string between two clamps, pulled by nothing else: what its middle is out of balance counts in units of the
// reaction.
TEST(Kkt, AResidualIsMeasuredByTheReactionWhereNoLoadActs) {
  VariationalInequality problem =
      small_problem(Eigen::Matrix3d{{1, -1, 0}, {-1, 2, -1}, {0, -1, 1}}, Eigen::Vector3d::Zero());
  problem.fixed = {0, 2};
  problem.fixed_values = Eigen::Vector2d(1, 0);
  Solution s = active_set(problem);
  s.u(1) += 0.5e-8;  // a force of 1e-8; the clamps bear 1/2
  EXPECT_NEAR(kkt_report(problem, s).residual, 2e-8, 1e-14);
}

// u_1 is locked under a load of 1e6, u_0 = 1: the scale of u is 1, however much B bears.
TEST(Kkt, ALoadThatTheStiffFormBearsIsNoMeasureOfU) {
  VariationalInequality problem = small_problem(Eigen::Matrix2d::Identity(), Eigen::Vector2d(1, 1e6),
                                                Eigen::VectorXd::Zero(1), Eigen::RowVector2d(0, 1), 0);
  Solution s;
  s.u = Eigen::Vector2d(1, 0);
  s.p = Eigen::VectorXd::Constant(1, 1e6);
  s.lambda = Eigen::VectorXd::Zero(1);
  EXPECT_EQ(worst_violation(kkt_report(problem, s)), 0);
  s.u(1) = 1e-3;
  s.moderate = 1e3;  // the first iterate was larger: u is what counts, down to a millionth of that
  EXPECT_NEAR(kkt_report(problem, s).residual, 1e-3, 1e-15);
  s.u(1) = 0;
  problem.lower(0) = 1.001;
  EXPECT_NEAR(kkt_report(problem, s).min_gap, -1e-3 / 1.001, 1e-15);
}

TEST(Certify, RefusesTheAnswerOfAWrongContactSet) {
  for (const double epsilon : {1.0, 1e-2, 0.0}) {
    const Solved s(epsilon);
    // hold the wrong unknowns by fixing them where the obstacle is: a linear problem whose equations all hold
    for (const bool one_more : {true, false}) {
      std::vector<bool> active = s.solution.active;
      if (one_more)
        active[loose(s.solution)] = true;
      else
        active[held(s.solution)] = false;
      Solution wrong = active_set(held_in_contact(s.problem, active));
      const SplitResidual r = exact_residual(s.problem, wrong.u, wrong.p, Eigen::VectorXd());
      wrong.lambda = Eigen::VectorXd::Zero(s.problem.lower.size());
      for (std::size_t i = 0; i < active.size(); ++i)
        if (active[i]) wrong.lambda(static_cast<Eigen::Index>(i)) = -r.r1(s.problem.contact[i]);
      wrong.active = active;
      EXPECT_LT(kkt_report(s.problem, wrong).residual, 1e-8);
      EXPECT_THROW(check_kkt(s.problem, wrong), NotConverged) << "epsilon " << epsilon << ", one more: " << one_more;
    }
  }
}

TEST(Certify, RefusesWrongAnswersWithoutContactToo) {
  const SpaceOn space(structured_mesh(6), p1());
  const VariationalInequality problem = assemble(Scene({paper_load}, StiffLayer{0.1}), space);
  const Solution right = active_set(problem);
  Solution wrong = right;
  wrong.u *= 1.001;
  EXPECT_THROW(check_kkt(problem, wrong), NotConverged);
  wrong = right;
  wrong.p *= 1.001;
  EXPECT_THROW(check_kkt(problem, wrong), NotConverged);
  wrong = right;
  const int corner = 0;  // (0, -1): its neighbours' equations barely see it, only the clamp itself
  ASSERT_EQ(problem.fixed[0], corner);
  wrong.u(corner) = 1e-9;
  EXPECT_THROW(check_kkt(problem, wrong), NotConverged) << "a clamp that slipped";
  // the report is linear in what is wrong: above the lower level there is a warning
  wrong = right;
  wrong.p *= 1.001;
  const double unit = worst_violation(kkt_report(problem, wrong)) / 1e-3;
  for (const double reached : {3e-10, 3e-9}) {
    wrong = right;
    wrong.p *= 1 + reached / unit;
    check_kkt(problem, wrong);
    EXPECT_EQ(wrong.warning.empty(), reached < TrustLevels{}.trusted) << wrong.warning;
  }
  VariationalInequality none = problem;
  none.load.setZero();
  EXPECT_EQ(worst_violation(active_set(none).kkt), 0) << "0 of nothing is 0";
}

// ==== Uzawa, the paper's algorithm: slow, but to the same answer; or no answer.

UnilateralContact gap() {
  return {[](double x) { return x * (x - 0.4) * (1 - x); }};
}

TEST(Uzawa, AgreesWithTheActiveSet) {
  for (const SpaceOn& space : two_square_spaces(10, {&p1(), &crouzeix_raviart()})) {
    for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-6, 0.0}) {
      if (&space.element() == &p1() && space.name.starts_with("unstructured") && epsilon < 1e-2)
        continue;  // locked: lambda without bounds
      const VariationalInequality problem = stiff_problem(space, epsilon, gap());
      const Solution slow = uzawa(problem), fast = active_set(problem);
      EXPECT_LT(relative_difference(slow.u, fast.u), 1e-7) << space.name << epsilon;
      EXPECT_EQ(slow.active, fast.active) << space.name << epsilon;
      EXPECT_GT(slow.counters.contact, 3 * fast.counters.contact);
      EXPECT_EQ(std::ssize(slow.history), slow.counters.contact);
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
      EXPECT_LT(relative_difference(paper.u, active_set(problem).u), 1e-7) << element->name() << epsilon;
      EXPECT_EQ(static_cast<int>(paper.history.size()), paper.counters.contact);
      EXPECT_GE(paper.counters.solves, paper.counters.contact);
    }
  }
  expect_refused([&] { uzawa_cg_ilut(stiff_problem(Space(mesh, p1()), 0)); }, "epsilon = 0");
}

TEST(Uzawa, RefusesAStepThatGoesNowhere) {
  const TriangleMesh mesh = structured_mesh(4);
  const VariationalInequality problem = stiff_problem(Space(mesh, p1()), 1);
  for (const double step : {0.0, -1.0, nan}) {
    UzawaOptions options;
    options.step = step;
    expect_refused([&] { uzawa(problem, options); }, "accepted: a positive number");
    expect_refused([&] { uzawa_cg_ilut(problem, options); }, "accepted: a positive number");
  }
  UzawaOptions options;
  options.enough = {1e-6, 1e-3};
  expect_refused([&] { uzawa_cg_ilut(problem, options); }, "options.enough");
}

TEST(Uzawa, WithThePapersLinearSolverIsRightOrSaysThatItIsNot) {
  // on meshes that are not aligned ILUT breaks down for small epsilon: an exception, or an answer that holds
  for (const auto& [name, mesh] : two_square_meshes(8)) {
    const Space space(mesh, crouzeix_raviart());
    for (const double epsilon : {1e-2, 1e-4, 1e-6, 1e-8, 1e-12}) {
      const VariationalInequality problem = stiff_problem(space, epsilon);
      UzawaOptions options;
      options.max_steps = 2000;
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
  const auto stop = [](const std::string& element_name, const TriangleMesh& mesh, const TriangleMesh& coarse) {
    const Space space(mesh, element(element_name));
    for (const double epsilon : {1.0, 1e-2, 1e-6}) {
      const TruthTable truth(Truth(paper_sine_load(), epsilon, true, 14));
      const VariationalInequality problem = stiff_problem(space, epsilon);
      UzawaOptions options;
      const Solution full = uzawa(problem);
      options.enough = accurate_enough(energy_bracket(test::stiff_scene(epsilon), coarse), 2);
      const Solution early = uzawa(problem, options);
      EXPECT_LT(2 * early.counters.contact, full.counters.contact)
          << element_name << epsilon;  // it looks every 32 steps
      EXPECT_LE(early.counters.corrections, full.counters.corrections);
      const Errors a = measure_errors(space, full, epsilon, reference(truth)),
                   b = measure_errors(space, early, epsilon, reference(truth));
      // the promise of accurate_enough
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
    // epsilon^2 > penalty: one matrix, no corrections, so that |u - u_h|_a^2 / 2 is below the gap to the last digit
    const VariationalInequality problem = stiff_problem(Space(mesh, crouzeix_raviart()), 1e-2, obstacle);
    const Eigen::VectorXd exact = active_set(problem).u;
    UzawaOptions options;
    int steps = 0;
    for (const double energy : {1e-4, 1e-6, 1e-8, 1e-10}) {
      options.enough = {energy, 1e-3};
      const Solution s = uzawa(problem, options);
      const Eigen::VectorXd e = s.u - exact, strain = problem.b * e;
      const double left =
          0.5 * (e.dot(problem.a1 * e) + strain.dot(problem.m.cwiseProduct(strain)) / problem.compliance);
      EXPECT_LE(left, energy);
      EXPECT_GE(s.counters.contact, steps) << "more asked, more steps";
      steps = s.counters.contact;
    }
    EXPECT_GT(steps, 32) << "the gap is asked for once per 32 steps";
  }
}

TEST(Uzawa, TheStepLengthChangesTheCostNotTheAnswer) {
  const TriangleMesh mesh = structured_mesh(8);
  const VariationalInequality problem = stiff_problem(Space(mesh, p1()), 1);
  const Solution chosen = uzawa(problem);
  // the largest eigenvalue of the compliance bounds the step from above by 2 over it
  const PenaltyFactor factor(problem);
  const Eigen::MatrixXd& l = factor.contact_block();
  const double largest = 1 / symmetric_eigenvalues(test::product(l, l.transpose())).minCoeff();
  UzawaOptions options;
  for (const double step : {0.3, 1.0, 1.9}) {
    options.step = step / largest;
    const Solution s = uzawa(problem, options);
    EXPECT_LT(relative_difference(s.u, chosen.u), 1e-7) << step;
    EXPECT_GE(1.2 * s.counters.contact, chosen.counters.contact) << "the chosen step is about the best, " << step;
  }
  options.step = 4 / largest;  // beyond the bound: it swings for ever
  options.max_steps = 5000;
  EXPECT_THROW(uzawa(problem, options), NotConverged);
}

/// A chain of five springs in units that lie 4 decades apart, so that its compliances lie 8 apart, over an obstacle.
VariationalInequality chain_in_units_apart() {
  const Eigen::VectorXd unit{{1, 1e4, 1e-4, 1, 1e2}};
  return small_problem(unit.asDiagonal() * chain(5) * unit.asDiagonal(),
                       unit.cwiseProduct(Eigen::VectorXd{{-1, -2, 0.5, 1, -3}}),
                       Eigen::VectorXd{{-0.5, -1, -0.25, 0, -2}}.cwiseQuotient(unit));
}

TEST(Uzawa, UnitsDecadesApartTakeAStepEach) {
  const VariationalInequality problem = chain_in_units_apart();
  const Solution exact = active_set(problem), s = uzawa(problem);
  EXPECT_LT(s.counters.contact, 500);  // one step for all takes more than a million
  EXPECT_EQ(s.active, exact.active);
  EXPECT_LT(relative_difference(s.u, exact.u), 1e-9);
}

TEST(Uzawa, StepsFindTheForcesOfEquations) {
  VariationalInequality problem = chain_in_units_apart();
  problem.upper = Eigen::VectorXd::Constant(5, infinity);
  problem.lower(1) = problem.upper(1) = 0.25e-4;
  problem.lower(3) = problem.upper(3) = -0.125;
  const Solution exact = active_set(problem), s = uzawa(problem);
  EXPECT_LT(relative_difference(s.u, exact.u), 1e-9);
  EXPECT_EQ(s.active, exact.active);
}

/// 2 u = -10 + lambda, u >= -1.
VariationalInequality one_spring() {
  return small_problem(Eigen::MatrixXd::Constant(1, 1, 2), Eigen::VectorXd{{-10}}, Eigen::VectorXd{{-1}});
}

TEST(Uzawa, OneUnknownStopsAtEitherBound) {
  VariationalInequality problem = one_spring();
  problem.upper = Eigen::VectorXd{{3}};
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
    options.enough = {energy, 1};
    EXPECT_EQ(uzawa(one_spring(), options).counters.contact == 0, energy > 16) << energy;
  }
  // a bound that bears no more than 3 takes up 3 * 4 on the way to -5: J(-5) = -25 + 12
  VariationalInequality soft = one_spring();
  soft.force_bound = Eigen::VectorXd{{3}};
  for (const double energy : {11.9, 12.1}) {
    options.enough = {energy, 1};
    EXPECT_EQ(uzawa(soft, options).counters.contact == 0, energy > 12) << energy;
  }
}

TEST(Uzawa, AsksTheCorrectionsForItsOwnToleranceButNoLessThan1em12) {
  VariationalInequality problem = one_spring();
  problem.b = RowMatrix(Eigen::MatrixXd::Ones(1, 1).sparseView());
  problem.m = Eigen::VectorXd::Ones(1);
  problem.compliance = 1e-6;
  PenaltyFactor factor(problem, 1);
  UzawaOptions options;
  for (const double tolerance : {1e-8, 1e-12, 1e-14}) {
    double asked = 0;
    options.tolerance = tolerance;
    options.progress = [&](const Progress& progress) {
      if (progress.stage == "corrections") asked = progress.asked;
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
  options.max_steps = 5;
  for (const auto& solve : {+[](const VariationalInequality&p, const UzawaOptions&o) { return uzawa(p, o); },
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
    EXPECT_EQ(s.counters.contact, 0) << s.solver;
    EXPECT_EQ(s.counters.solves, 1) << s.solver;
    EXPECT_LT(relative_difference(s.u, active_set(problem).u), 1e-9) << s.solver;
  }
}

TEST(Uzawa, TheLargestEigenvalueOfAnOperatorIsThatOfItsMatrix) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(
      20, 20, [](Eigen::Index i, Eigen::Index j) { return std::exp(-0.3 * std::abs(static_cast<double>(i - j))); });
  for (const int size : {1, 2, 3, 20}) {
    const Eigen::MatrixXd part = a.topLeftCorner(size, size);
    const double truth = symmetric_eigenvalues(part).maxCoeff();
    const double found = largest_eigenvalue([&](const Eigen::VectorXd& x) { return Eigen::VectorXd(part * x); }, size);
    EXPECT_NEAR(found, truth, 1e-6 * truth) << size;
    EXPECT_LE(found, truth * (1 + 1e-12)) << size;  // from below
  }
}

TEST(Uzawa, FollowsThePenaltyWhereTheCorrectionsTakeASmallerOne) {
  // a penalty that is too large for a locked layer: after 15 corrections the factor is made anew, and S with it
  const SpaceOn space(unstructured_mesh(8), p1());
  VariationalInequality problem = stiff_problem(space, 1e-6);
  PenaltyFactor factor(problem, 1e-2);
  const Solution direct = active_set(problem), projected = uzawa(problem, factor);
  EXPECT_GT(projected.counters.factorisations, 1);
  EXPECT_LT((direct.u - projected.u).cwiseAbs().maxCoeff(), 1e-8 * direct.u.cwiseAbs().maxCoeff());
}

// ==== Bounds of other shapes: from above, from both sides, on combinations of unknowns. The same solvers, the same report.

RowMatrix rows_of(const Eigen::MatrixXd& rows) {
  RowMatrix sparse = rows.sparseView();
  sparse.makeCompressed();
  return sparse;
}

// ---- A string between a floor and a ceiling.

/// -u'' = f on (0, 1), u = 0 at the ends, f = Q on the left half and -Q on the right one, -floor <= u <= ceiling. A
/// parabola of curvature Q leaves each bound with slope 0. From the clamp to the ceiling it takes c_1, from the floor to
/// the clamp c_2 and from the middle to either s:
///     ceiling = Q c_1^2 / 2,   floor = Q c_2^2 / 2,   ceiling + floor = Q s^2.
/// With c_1 = 7 h, c_2 = h, s = 5 h the ends of contact are nodes, and P1 is exact at the nodes, forces included.
struct String {
  int n = 32;
  double h = 1.0 / 32, load = 3, ceiling = load * 49 * h * h / 2, floor = load * h * h / 2;
  VariationalInequality problem;
  Eigen::VectorXd u, lambda;  ///< the truth at all nodes and at the bounded ones

  String() {
    std::vector<Eigen::Triplet<double>> a1;
    for (int cell = 0; cell < n; ++cell)
      for (const auto& [i, j] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}})
        a1.emplace_back(cell + i, cell + j, (i == j ? 1 : -1) / h);
    problem.a1.resize(n + 1, n + 1);
    problem.a1.setFromTriplets(a1.begin(), a1.end());
    problem.b.resize(0, n + 1);
    problem.load.resize(n + 1);
    for (int i = 0; i <= n; ++i) problem.load(i) = i == n / 2 ? 0 : i < n / 2 ? load * h : -load * h;
    problem.fixed = {0, n};
    problem.fixed_values = Eigen::Vector2d::Zero();
    for (int i = 1; i < n; ++i) problem.contact.push_back(i);
    problem.lower = Eigen::VectorXd::Constant(n - 1, -floor);
    problem.upper = Eigen::VectorXd::Constant(n - 1, ceiling);
    u.setZero(n + 1);
    lambda.setZero(n - 1);
    const int on = 7, off = n / 2 - 5, down = n / 2 + 5, up = n - 1;
    for (int i = 1; i < n; ++i) {
      const auto parabola = [&](int from) { return load * h * h * (i - from) * (i - from) / 2; };
      u(i) = i < on       ? ceiling - parabola(on)
             : i <= off   ? ceiling
             : i <= n / 2 ? ceiling - parabola(off)
             : i < down   ? parabola(down) - floor
             : i <= up    ? -floor
                          : parabola(up) - floor;
      if (i >= on && i <= off) lambda(i - 1) = -load * h * (i == on || i == off ? 0.5 : 1);
      if (i >= down && i <= up) lambda(i - 1) = load * h * (i == down || i == up ? 0.5 : 1);
    }
  }
};

TEST(StringBetweenFloorAndCeiling, IsTheClosedForm) {
  const String string;
  for (const Solution& s : {active_set(string.problem), uzawa(string.problem)}) {
    const double round_off = s.solver == "uzawa" ? 1e-7 : 1e-13;
    EXPECT_LT(relative_difference(s.u, string.u), round_off) << s.solver;
    EXPECT_LT(relative_difference(s.lambda, string.lambda), round_off) << s.solver;
    EXPECT_EQ(s.warning, "") << s.solver;
    for (std::size_t i = 0; i < s.active.size(); ++i)
      EXPECT_EQ(s.active[i], string.lambda(static_cast<Eigen::Index>(i)) != 0) << s.solver << i;
  }
}

TEST(StringBetweenFloorAndCeiling, AsCombinationsIsTheSame) {
  // each bounded value is minus three times an unknown: floor and ceiling change places
  String string;
  VariationalInequality& problem = string.problem;
  const int bounds = problem.bound_count();
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(bounds, problem.size());
  for (int k = 0; k < bounds; ++k) rows(k, problem.contact[k]) = -3;
  problem.contact.clear();
  problem.combinations = rows_of(rows);
  problem.lower = Eigen::VectorXd::Constant(bounds, -3 * string.ceiling);
  problem.upper = Eigen::VectorXd::Constant(bounds, 3 * string.floor);
  const Solution s = active_set(problem);
  EXPECT_LT(relative_difference(s.u, string.u), 1e-13);
  EXPECT_LT(relative_difference(s.lambda, -string.lambda / 3), 1e-13);
}

TEST(StringBetweenFloorAndCeiling, TheDualityGapOfUzawaBoundsWhatIsLeft) {
  const String string;
  UzawaOptions options;
  int steps = 0;
  for (const double energy : {1e-4, 1e-6, 1e-8}) {
    options.enough = {energy, 1e-2};
    const Solution s = uzawa(string.problem, options);
    const Eigen::VectorXd e = s.u - string.u;
    EXPECT_LE(0.5 * e.dot(string.problem.a1 * e), energy);
    EXPECT_GT(s.counters.contact, steps) << "more asked, more steps";
    steps = s.counters.contact;
  }
  EXPECT_LT(2 * steps, uzawa(string.problem).counters.contact);
}

TEST(StringBetweenFloorAndCeiling, TheNestedStartKnowsTheSides) {
  const String string;
  Eigen::MatrixXd s = Eigen::MatrixXd(string.problem.a1).block(1, 1, string.n - 1, string.n - 1);
  const Eigen::VectorXd q = string.problem.load.segment(1, string.n - 1);
  const Stairs stairs{string.problem.lower, string.problem.upper, {}};
  DenseContact system(s, q);
  EXPECT_LE(solve_contact(system, stairs, system.nested_start(stairs, 100), 100).steps, 3);
}

TEST(StringBetweenFloorAndCeiling, ASweepKeepsTheSides) {
  const String string;
  Sweep sweep(string.problem);
  sweep.solve();
  EXPECT_EQ(sweep.solve().counters.contact, 1) << "the same question again";
  sweep.set_bounds(string.problem.lower, Eigen::VectorXd::Constant(string.n - 1, infinity));
  VariationalInequality from_below = string.problem;
  from_below.upper.resize(0);
  const Eigen::VectorXd below = active_set(from_below).u;
  EXPECT_LT(relative_difference(sweep.solve().u, below), 1e-13);
  sweep.set_bounds(string.problem.lower, string.problem.upper);
  sweep.solve();
  sweep.set_bounds(string.problem.lower, Eigen::VectorXd());
  EXPECT_LT(relative_difference(sweep.solve().u, below), 1e-13) << "no upper bound is left to start from";
  sweep.set_bounds(string.problem.lower, Eigen::VectorXd::Constant(string.n - 1, infinity));
  expect_refused([&] { sweep.set_bounds(string.problem.upper, string.problem.lower); }, "accepted: lower <= upper");
  EXPECT_EQ(sweep.problem().upper(0), infinity) << "as before";
}

// ---- Signs and equations.

TEST(UpperBounds, AreLowerBoundsOfMinusU) {
  const SpaceOn space(unstructured_mesh(6), crouzeix_raviart());
  for (const double epsilon : {1.0, 1e-3, 0.0}) {
    const VariationalInequality below =
        stiff_problem(space, epsilon, {[](double x) { return x * (x - 0.4) * (1 - x); }});
    VariationalInequality above = below;
    above.load *= -1;
    above.upper = -below.lower;
    above.lower.setConstant(-infinity);
    const Solution one = active_set(below), other = active_set(above);
    EXPECT_GT(std::count(one.active.begin(), one.active.end(), true), 0);
    EXPECT_EQ(other.u, -one.u) << epsilon;  // bit by bit
    EXPECT_EQ(other.lambda, -one.lambda) << epsilon;
    EXPECT_EQ(other.active, one.active) << epsilon;
    EXPECT_EQ(other.kkt.min_gap, one.kkt.min_gap);
    EXPECT_EQ(other.kkt.min_pressure, one.kkt.min_pressure);
    EXPECT_EQ(other.kkt.complementarity, one.kkt.complementarity);
    const Solution slow = uzawa(above);
    EXPECT_EQ(slow.u, -uzawa(below).u) << epsilon;
  }
}

TEST(Equations, ArePrescribedValuesWithTheirReaction) {
  const SpaceOn space(structured_mesh(6), p1());
  for (const double epsilon : {1.0, 1e-3, 0.0}) {
    VariationalInequality held = stiff_problem(space, epsilon);
    for (Eigen::Index i = 0; i < held.lower.size(); ++i) held.lower(i) = i % 2 == 0 ? 0.01 : -0.01;
    held.upper = held.lower;
    held.upper(0) = infinity;  // one bound beside them
    const Solution s = active_set(held);
    for (std::size_t i = 1; i < held.contact.size(); ++i)
      EXPECT_EQ(s.u(held.contact[i]), held.lower(static_cast<Eigen::Index>(i)));
    VariationalInequality fixed = held;
    fixed.fixed.insert(fixed.fixed.end(), held.contact.begin() + 1, held.contact.end());
    fixed.fixed_values.conservativeResize(static_cast<Eigen::Index>(fixed.fixed.size()));
    fixed.fixed_values.tail(held.lower.size() - 1) = held.lower.tail(held.lower.size() - 1);
    fixed.contact.resize(1);
    fixed.lower.conservativeResize(1);
    fixed.upper.conservativeResize(1);
    const Solution truth = active_set(fixed);
    EXPECT_LT(relative_difference(s.u, truth.u), 1e-9) << epsilon;
    const Eigen::VectorXd reaction = -exact_residual(fixed, truth.u, truth.p, truth.lambda).r1;
    for (std::size_t i = 1; i < held.contact.size(); ++i)
      EXPECT_NEAR(s.lambda(static_cast<Eigen::Index>(i)), reaction(held.contact[i]), 1e-9) << epsilon;
    EXPECT_LT(s.lambda.minCoeff() * s.lambda.maxCoeff(), 0) << "reactions of both signs: the test means something";
    EXPECT_EQ(s.warning, "");
  }
}

// ---- Against all sets of bounds.

/// Two layers with their bodies on top of each other, their lines Gamma_C facing one another: u^1 - u^2 >= -gap there.
VariationalInequality two_bodies(const VariationalInequality& one, const VariationalInequality& other, double gap) {
  const auto beside = [](const auto& a, const auto& b) {
    Eigen::MatrixXd both = Eigen::MatrixXd::Zero(a.rows() + b.rows(), a.cols() + b.cols());
    both.topLeftCorner(a.rows(), a.cols()) = Eigen::MatrixXd(a);
    both.bottomRightCorner(b.rows(), b.cols()) = Eigen::MatrixXd(b);
    return both;
  };
  const auto then = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return (Eigen::VectorXd(a.size() + b.size()) << a, b).finished();
  };
  VariationalInequality both;
  both.a1 = beside(one.a1, other.a1).sparseView();
  both.b = rows_of(beside(one.b, other.b));
  both.m = then(one.m, other.m);
  both.load = then(one.load, other.load);
  both.compliance = one.compliance;
  both.fixed = one.fixed;
  for (const int i : other.fixed) both.fixed.push_back(one.size() + i);
  both.fixed_values = then(one.fixed_values, other.fixed_values);
  Eigen::MatrixXd gaps = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(one.contact.size()), both.size());
  for (Eigen::Index k = 0; k < gaps.rows(); ++k) {
    gaps(k, one.contact[k]) = 1;
    gaps(k, one.size() + other.contact[k]) = -1;
  }
  both.combinations = rows_of(gaps);
  both.lower = Eigen::VectorXd::Constant(gaps.rows(), -gap);
  return both;
}

TEST(TwoBodies, OfEqualShapeMeetHalfWay) {
  // the second body is the image of the first in the plane between them: each sees an obstacle at half the gap
  for (const SpaceOn& space : two_square_spaces(8, {&p1(), &crouzeix_raviart()})) {
    if (&space.element() == &p1() && space.name.starts_with("unstructured")) continue;  // locks: lambda has no bound
    for (const double compliance : {1.0, 1e-6, 0.0}) {
      SCOPED_TRACE(space.name + std::to_string(compliance));
      constexpr double gap = 1e-5;
      const VariationalInequality one = stiff_problem(space, std::sqrt(compliance), {[](double) { return gap / 2; }});
      VariationalInequality image = one;
      image.load *= -1;
      const Solution half = active_set(one);
      const VariationalInequality problem = two_bodies(one, image, gap);
      EXPECT_GT(std::count(half.active.begin(), half.active.end(), true), 1);
      for (const Solution& s : {active_set(problem), uzawa(problem)}) {
        const double within = s.solver == "uzawa" ? 1e-7 : 1e-9;
        EXPECT_LT(relative_difference(s.u.head(one.size()), half.u), within) << s.solver;
        EXPECT_LT(relative_difference(s.u.tail(one.size()), -half.u), within) << s.solver;
        EXPECT_LT(relative_difference(s.lambda, half.lambda), 10 * within) << s.solver;
        EXPECT_EQ(s.active, half.active) << s.solver;
        EXPECT_EQ(s.warning, "") << s.solver;
      }
    }
  }
}

TEST(Bounds, OfAllShapesAreTheBruteForceAnswer) {
  // a layer with its first contact unknown between two bounds, the second from above, the third in a combination with the
  // unknown over it and a clamped one, whose value is not zero
  const SpaceOn space(structured_mesh(4), p1());
  for (const double epsilon : {1.0, 1e-2, 1e-4})
    for (const double load : {1.0, -1.0, 0.1}) {
      VariationalInequality problem = stiff_problem(space, epsilon);
      problem.load *= load;
      problem.fixed_values(0) = 0.02;
      std::vector<char> taken(problem.size(), 0);
      for (const int i : problem.fixed) taken[i] = 1;
      for (const int i : problem.contact) taken[i] = 1;
      Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2, problem.size());
      const int third = problem.contact[2];
      problem.contact.pop_back();
      const int beside = static_cast<int>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
      rows(0, third) = 1;
      rows(0, beside) = -0.3;
      rows(0, problem.fixed[0]) = 0.7;
      rows(1, beside) = 1e3;
      rows(1, problem.contact[0]) = -2e3;  // bounded by itself
      problem.combinations = rows_of(rows);
      problem.lower = Eigen::Vector4d(-0.001, -infinity, 0, -0.5);
      problem.upper = Eigen::Vector4d(0.002, 0.001, infinity, 0.5);
      const test::BruteForce truth = test::brute_force(problem);
      for (const Solution& s : {active_set(problem), uzawa(problem)}) {
        const double within = s.solver == "uzawa" ? 1e-7 : 1e-9;
        EXPECT_LT(relative_difference(s.u, truth.u), within) << s.solver << epsilon << ", load " << load;
        EXPECT_LT(relative_difference(s.lambda, truth.lambda), 10 * within) << s.solver << epsilon << ", load " << load;
        EXPECT_EQ(s.active, truth.active) << s.solver << epsilon << ", load " << load;
        EXPECT_EQ(s.u(problem.fixed[0]), 0.02);
      }
    }
}

// ---- A block on a slope.

/// The platen of plane strain, turned by `angle`: clamped above and pushed 0.1 into an obstacle below.
struct Turned {
  TriangleMesh mesh;
  Space x, y;
  VariationalInequality problem;

  Turned(TriangleMesh flat, double angle, const Element& element, double epsilon)
      : mesh(turned(std::move(flat), angle)), x(mesh, element), y(mesh, element) {
    problem = assemble(platen(epsilon, element.conforming() ? 0 : 1), {x, y});
    // the clamped edges move along the turned axis; the bounds are on the turned normal
    const double c = std::cos(angle), s = std::sin(angle);
    for (std::size_t i = 0; i < problem.fixed.size(); ++i)
      problem.fixed_values(static_cast<Eigen::Index>(i)) = problem.fixed[i] < x.size() ? 0.1 * s : -0.1 * c;
    const auto along = [&](int i) { return c * x.points()(i, 0) + s * x.points()(i, 1); };
    std::sort(problem.contact.begin(), problem.contact.end(),
              [&](int i, int j) { return along(i - x.size()) < along(j - x.size()); });  // as on the flat one
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(problem.lower.size(), problem.size());
    for (Eigen::Index k = 0; k < normal.rows(); ++k) {
      const int i = problem.contact[k] - x.size();
      problem.lower(k) = -std::pow(along(i) - 0.5, 2);
      normal(k, i) = -s;
      normal(k, x.size() + i) = c;
    }
    problem.contact.clear();
    problem.combinations = rows_of(normal);
  }

  static TriangleMesh turned(TriangleMesh mesh, double angle) {
    mesh.vertices *= Eigen::Rotation2Dd(angle).toRotationMatrix().transpose();
    return mesh;
  }
};

TEST(BlockOnASlope, IsTheFlatOneTurned) {
  const TriangleMesh crossed = with_free_sides(structured_mesh(8, Domain{0}, Diagonal::crossed)),
                     right = with_free_sides(structured_mesh(8, Domain{0}));
  for (const auto& [mesh, element] : {std::pair{&crossed, &p1()}, {&right, &crouzeix_raviart()}})
    for (const double epsilon : {1.0, 1e-6, 0.0}) {
      const Space x(*mesh, *element), y(*mesh, *element);
      const Solution flat = active_set(assemble(platen(epsilon, element->conforming() ? 0 : 1), {x, y}));
      EXPECT_GT(std::count(flat.active.begin(), flat.active.end(), true), 2);
      EXPECT_GT(std::count(flat.active.begin(), flat.active.end(), false), 2);
      for (const double angle : {0.5, 2.2, -1.5707963267948966}) {
        SCOPED_TRACE(element->name() + ", epsilon " + std::to_string(epsilon) + ", angle " + std::to_string(angle));
        const Turned slope(*mesh, angle, *element, epsilon);
        const Solution s = active_set(slope.problem);
        const Eigen::MatrixX2d back =
            s.u.reshaped(x.size(), 2) * Eigen::Rotation2Dd(angle).toRotationMatrix();  // a point per row
        EXPECT_LT(relative_difference(back.reshaped(), flat.u), 1e-10);
        EXPECT_LT(relative_difference(s.lambda, flat.lambda), 1e-9);
        EXPECT_EQ(s.active, flat.active);
        EXPECT_EQ(s.warning, "");
        EXPECT_LT(worst_violation(s.kkt), 1e-9);
      }
    }
}

// ---- Bounds on combinations.

/// Three points (u_x, u_y) on springs.
VariationalInequality springs(const Eigen::MatrixXd& rows, const Eigen::VectorXd& load) {
  VariationalInequality problem = small_problem(Eigen::MatrixXd::Identity(load.size(), load.size()), load);
  problem.combinations = rows_of(rows);
  problem.lower = Eigen::VectorXd::Zero(rows.rows());
  return problem;
}

TEST(Combinations, APointInAGrooveStandsOnBothWalls) {
  // walls of normals (sin a, cos a) and (-sin a, cos a): no unknown is one wall's alone. Pressed into the edge u = 0.
  const double a = 0.7;
  Eigen::MatrixXd walls(2, 2);
  walls << std::sin(a), std::cos(a), -std::sin(a), std::cos(a);
  const Eigen::Vector2d load(0.3, -1);
  const Solution s = active_set(springs(walls, load));
  EXPECT_LT(s.u.norm(), 1e-15);
  const Eigen::Vector2d truth = walls.transpose().inverse() * -load;
  EXPECT_GT(truth.minCoeff(), 0);
  EXPECT_LT((s.lambda - truth).norm(), 1e-15);
  // pulled up along one wall and into it, it slides there, held by this wall alone
  const Eigen::Vector2d up(-std::cos(a), std::sin(a));
  const Solution t = active_set(springs(walls, up - 0.1 * walls.row(0).transpose()));
  EXPECT_LT((t.u - up).norm(), 1e-15);
  EXPECT_LT((t.lambda - Eigen::Vector2d(0.1, 0)).norm(), 1e-15);
}

TEST(Combinations, MayShareUnknownsAndDependOnEachOther) {
  const Eigen::Vector4d load(1, -2, 3, -4);
  const auto right = [](const VariationalInequality& problem) {
    const test::ExactAnswer truth = test::exact_answer(problem);
    ASSERT_EQ(truth.what, test::Exactly::solved);
    for (const Solution& s : {active_set(problem), uzawa(problem)})
      EXPECT_LT((s.u - truth.u).lpNorm<Eigen::Infinity>(), 1e-8 * truth.u.lpNorm<Eigen::Infinity>()) << s.solver;
  };
  Eigen::MatrixXd rows(3, 4);
  rows << 1, -1, 0, 0, 0, 1, -1, 0, 1, 0, -1, 0;  // the third is the sum of the others
  right(springs(rows, load));
  rows(2, 2) = -1 + 1e-3;
  right(springs(rows, load));
  // more rows than unknowns
  Eigen::MatrixXd many(5, 4);
  many << 1, 0.5, 0, 0, 0, 1, 0.25, 0, 0, 0, 1, 0.5, 1, 1, 1, 1, 0.5, 0, 0, -1;
  right(springs(many, load));
}

TEST(Combinations, TheUnitsOfARowAndOfForcesDoNotMatter) {
  Eigen::MatrixXd rows(2, 4);
  rows << 1, -0.5, 0, 0, 0, 0.3, 1, 1;
  VariationalInequality problem = springs(rows, Eigen::Vector4d(-1, 2, -3, 0.5));
  problem.lower << -0.1, -0.2;
  problem.upper = Eigen::Vector2d(0.1, infinity);
  const Solution one = active_set(problem);
  EXPECT_EQ(std::count(one.active.begin(), one.active.end(), true), 2);
  for (const auto& [unit, force] : {std::pair{0x1p-60, 1.0}, {0x1p60, 1.0}, {1.0, 0x1p60}}) {
    VariationalInequality other = problem;
    other.combinations *= unit;
    other.lower *= unit;
    other.upper *= unit;
    other.a1 *= force, other.load *= force;
    const Solution s = active_set(other);
    EXPECT_EQ(s.u, one.u);  // powers of two: bit by bit
    EXPECT_EQ(s.lambda, one.lambda * (force / unit));
    EXPECT_EQ(s.kkt.min_gap, one.kkt.min_gap);
    EXPECT_EQ(s.kkt.complementarity, one.kkt.complementarity);
    EXPECT_EQ(s.kkt.min_pressure, one.kkt.min_pressure);
  }
}

// ---- What cannot be met, and what is refused.

TEST(Bounds, ThatNoUCanMeetAreRefusedUnderAnyLoad) {
  // compliance 0 and B: u_0 - u_1 = 0; the bounds ask for u_0 - u_1 >= 0.05, in three shapes
  for (const double load : {1.0, 1e6, 1e12, 1e18})
    for (const int shape : {0, 1, 2}) {
      VariationalInequality problem = springs(Eigen::MatrixXd(0, 3), load * Eigen::Vector3d(1, 2, -3));
      problem.b = rows_of(Eigen::RowVector3d(1, -1, 0));
      problem.m = Eigen::VectorXd::Ones(1);
      problem.compliance = 0;
      if (shape == 0) {
        problem.combinations = rows_of(Eigen::RowVector3d(1, -1, 0));
        problem.lower = Eigen::VectorXd::Constant(1, 0.05);
      } else {
        problem.combinations.resize(0, 0);
        problem.contact = {0, 1};
        problem.lower = Eigen::Vector2d(0.05, shape == 1 ? -1 : -infinity);
        problem.upper = Eigen::Vector2d(infinity, 0);
      }
      EXPECT_THROW(active_set(problem), NotConverged) << load << ", shape " << shape;
      problem.upper = Eigen::VectorXd::Constant(problem.bound_count(), infinity);
      problem.lower(0) = -0.05;
      if (shape > 0) problem.upper(1) = 0;
      if (load < 1e12) {
        EXPECT_NO_THROW(active_set(problem)) << load << ", shape " << shape;
      }
    }
}

TEST(Bounds, AGreatUElsewhereHidesNoUpperBound) {
  // where a bound or B may be impossible to meet every violation counts: u_1 stops at 0.1 though u_0 is 1e14
  VariationalInequality problem = springs(Eigen::MatrixXd(0, 4), Eigen::Vector4d(1e14, 0.2, 1, -1));
  problem.b = rows_of(Eigen::RowVector4d(0, 0, 1, 0));
  problem.m = Eigen::VectorXd::Ones(1);
  problem.compliance = 0;
  problem.contact = {1, 3};
  problem.lower = Eigen::Vector2d(-infinity, 0.01);
  problem.upper = Eigen::Vector2d(0.1, infinity);
  const Solution s = active_set(problem);
  EXPECT_NEAR(s.u(1), 0.1, 1e-12);
  EXPECT_NEAR(s.u(3), 0.01, 1e-12);
  EXPECT_NEAR(s.lambda(0), -0.1, 1e-12);
}

TEST(KktOfBounds, ReportsEachSideOfABoundByItself) {
  const String string;
  const Solution right = active_set(string.problem);
  const double u = right.u.lpNorm<Eigen::Infinity>(), f = right.lambda.lpNorm<Eigen::Infinity>();
  const int top = 8, bottom = 24, between = 15;  // nodes; the bound of node i is i - 1
  Solution wrong = right;
  wrong.u(top) = string.ceiling + 0.1 * u;  // the largest u now
  EXPECT_NEAR(kkt_report(string.problem, wrong).min_gap, -0.1 / 1.1, 1e-12);
  wrong = right;
  wrong.u(bottom) = -string.floor - 0.1 * u;
  EXPECT_NEAR(kkt_report(string.problem, wrong).min_gap, -0.1, 1e-12);
  // a force that is right at one side is none at the other: the gap times the force tells
  wrong = right;
  wrong.lambda(top - 1) *= -1;
  EXPECT_NEAR(kkt_report(string.problem, wrong).complementarity, (string.ceiling + string.floor) / u, 1e-12);
  wrong = right;
  wrong.lambda(between - 1) = 0.1 * f;
  EXPECT_NEAR(kkt_report(string.problem, wrong).complementarity, 0.1 * (right.u(between) + string.floor) / u, 1e-12);
  // from above alone, a push from below is wrong whatever the gap
  VariationalInequality above = string.problem;
  above.lower.setConstant(-infinity);
  wrong = active_set(above);
  wrong.lambda(top - 1) = 0.1 * wrong.lambda.lpNorm<Eigen::Infinity>();
  EXPECT_LT(kkt_report(above, wrong).min_pressure, -0.05);
  EXPECT_THROW(check_kkt(above, wrong), NotConverged);
}

TEST(KktOfBounds, ReportsCombinationsInTheirOwnUnits) {
  Eigen::MatrixXd rows(1, 3);
  rows << 1e3, -1e3, 0;
  VariationalInequality problem = springs(rows, Eigen::Vector3d(-1, 1, 5));
  const Solution right = active_set(problem);
  EXPECT_NEAR(right.lambda(0), 1e-3, 1e-15);
  const double u = right.u.lpNorm<Eigen::Infinity>();
  EXPECT_EQ(u, 5);
  Solution wrong = right;
  wrong.u(0) -= 0.1 * u;
  EXPECT_NEAR(kkt_report(problem, wrong).min_gap, -0.05, 1e-12);  // of 1e3 (u_0 - u_1), at most 2e3 |u|
  wrong = right;
  wrong.lambda(0) = -1e-4;
  EXPECT_LT(kkt_report(problem, wrong).min_pressure, -0.01) << "a pull on two soft unknowns beside a great load";
  EXPECT_GT(kkt_report(problem, wrong).residual, 0.01);
}

TEST(CheckBounds, RefusesBoundsThatAreNone) {
  const String string;
  const auto refused = [&](const std::function<void(VariationalInequality&)>& spoil, const std::string& words) {
    VariationalInequality bad = string.problem;
    spoil(bad);
    expect_refused([&] { check(bad); }, words);
    expect_refused([&] { active_set(bad); }, words);
    expect_refused([&] { uzawa(bad); }, words);
    expect_refused([&] { kkt_report(bad, Solution{}); }, words);
  };
  using P = VariationalInequality;
  const double nan = std::nan("");
  refused([](P& p) { p.lower(3) = p.upper(3) + 1e-9; }, "accepted: lower <= upper");
  refused([](P& p) { p.lower(3) = -infinity, p.upper(3) = infinity; }, "bound 3 is not finite");
  refused([](P& p) { p.lower(3) = infinity; }, "bound 3 is not finite");
  refused([](P& p) { p.upper(3) = -infinity; }, "bound 3 is not finite");
  refused([nan](P& p) { p.upper(3) = nan; }, "not finite");
  refused([](P& p) { p.upper.conservativeResize(5); }, "upper has 5 entries");
  refused([](P& p) { p.combinations.resize(1, 3); }, "combinations have 3 columns");
  const auto with_row = [](P& p, double value) {
    p.contact.pop_back();
    Eigen::MatrixXd row = Eigen::MatrixXd::Zero(1, p.size());
    row(0, p.size() - 2) = 1;
    p.combinations = rows_of(row);
    p.combinations.valuePtr()[0] = value;
  };
  refused([&](P& p) { with_row(p, nan); }, "an entry of combinations is not finite");
  refused([&](P& p) { with_row(p, 0); }, "combination 0 holds no free unknown");
  refused([&](P& p) { with_row(p, 1), p.lower.conservativeResize(3); }, "one bound per contact unknown and per");
  refused([&](P& p) { with_row(p, 1), p.combinations.uncompress(); }, "compressed");
}

TEST(Refused, WhereABoundOfAnotherShapeIsNotKnown) {
  const SpaceOn space(structured_mesh(4), crouzeix_raviart());
  const Scene scene = test::stiff_scene(1);
  VariationalInequality above = assemble(scene, space), combined = above;
  above.upper = Eigen::VectorXd::Constant(above.lower.size(), 1.0);
  Eigen::MatrixXd row = Eigen::MatrixXd::Zero(1, combined.size());
  row(0, combined.contact.back()) = 1;
  combined.contact.pop_back();
  combined.combinations = rows_of(row);
  for (const VariationalInequality* problem : {&above, &combined}) {
    const Solution s = active_set(*problem);
    const std::string words = "accepted: lower bounds on unknowns";
    expect_refused([&] { certify(scene, space, *problem, s, CertificateOptions{}); }, words);
    expect_refused([&] { uzawa_cg_ilut(*problem); }, words);
    expect_refused([&] { naive_summed_solve(*problem, SummedFactor::cholesky); }, words);
  }
  const Solution s = active_set(above);
  const Eigen::MatrixX3d table = contact_table(space, above, s);
  EXPECT_GE(table.col(1).minCoeff(), -1e-15);
  EXPECT_EQ(contact_zone(space, above, s).active, std::count(s.active.begin(), s.active.end(), true));
  const std::string words = "accepted: bounds on unknowns";
  const Solution c = active_set(combined);
  expect_refused([&] { contact_table(space, combined, c); }, words);
  expect_refused([&] { contact_zone(space, combined, c); }, words);
  // a combination of one unknown is that unknown, by a factor made before and in a sweep, too
  PenaltyFactor factor(combined);
  const Eigen::VectorXd u = active_set(assemble(scene, space)).u;
  for (const Solution& answer : {c, active_set(combined, factor), uzawa(combined, factor), Sweep(combined).solve()})
    EXPECT_LT(relative_difference(answer.u, u), 1e-8) << answer.solver;
}

// ==== Bounds on many unknowns: the sparse road beside the dense one, problem by problem.

/// The answer by one road, or the message of its refusal.
struct Outcome {
  Solution s;
  std::string refusal;
};

Outcome by(ContactRoad road, const VariationalInequality& problem) {
  try {
    ActiveSetOptions options;
    options.road = road;
    return {active_set(problem, options), ""};
  } catch (const Error& error) {
    return {{}, error.what()};
  }
}

/// The distance of two answers, relative to the largest |u|. Where u locks (it tends to 0 and keeps no more digits than
/// those of its size before) to 1e-4 of that size.
double apart(const Solution& a, const Solution& b) {
  const double distance = (a.u - b.u).lpNorm<Eigen::Infinity>();
  return distance == 0 ? 0 : distance / std::max(a.u.lpNorm<Eigen::Infinity>(), 1e-4 * a.moderate);
}

/// Both roads on one list of problems: how many both answer without a warning, and how many one of them refuses alone, and how
/// far apart the answers are.
struct Agreement {
  int answered = 0, other = 0, beyond = 0;  ///< beyond: further apart than 1e-10
  double furthest = 0;
};
Agreement compare(const std::function<VariationalInequality(unsigned)>& problem_of, unsigned seeds) {
  Agreement agreement;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    const VariationalInequality problem = problem_of(seed);
    const Outcome dense = by(ContactRoad::dense, problem), sparse = by(ContactRoad::sparse, problem);
    const auto plain = [](const Outcome& o) { return o.refusal.empty() && o.s.warning.empty(); };
    agreement.other += dense.refusal.empty() != sparse.refusal.empty();
    if (!plain(dense) || !plain(sparse)) continue;
    ++agreement.answered;
    agreement.beyond += apart(dense.s, sparse.s) > 1e-10;
    agreement.furthest = std::max(agreement.furthest, apart(dense.s, sparse.s));
  }
  return agreement;
}

// Small problems of every kind: with and without B, compliance 0 to above 1, prescribed values, infeasible, singular.
TEST(ManyBounds, BothRoadsAgreeOnRandomProblems) {
  const Agreement agreement = compare(hard::random_problem, 1500);
  EXPECT_GT(agreement.answered, 1200);
  EXPECT_LE(agreement.furthest, 1e-10);
  EXPECT_LE(agreement.other, 6);  // measured: 5; over 6000 10, six of them answered by the sparse road alone
}

TEST(ManyBounds, BothRoadsAgreeOnBoundsOfOtherShapes) {
  const Agreement agreement = compare(hard::random_bounds, 1500);
  EXPECT_GT(agreement.answered, 1000);
  EXPECT_LE(agreement.beyond, 1);  // number 1063: the dense road is 9e-11 from the exact u, the sparse one 9e-10
  EXPECT_LE(agreement.furthest, 2e-9);
  EXPECT_LE(agreement.other, 10);
}

TEST(ManyBounds, BothRoadsAgreeOnBoundsThatGiveWay) {
  const Agreement agreement = compare(hard::random_friction, 600);
  EXPECT_GT(agreement.answered, 400);
  EXPECT_LE(agreement.furthest, 1e-10);
  EXPECT_LE(agreement.other, 4);
}

/// The layer problem on 8 x 8 squares with every free unknown of the layer, y <= 0, bounded from below.
VariationalInequality layer_under_bounds(const TriangleMesh& mesh, const std::string& element_name, double epsilon) {
  const Space space(mesh, element(element_name));
  VariationalInequality problem = stiff_problem(space, epsilon);
  std::vector<char> fixed(problem.size(), 0);
  for (const int i : problem.fixed) fixed[i] = 1;
  problem.contact.clear();
  for (int i = 0; i < problem.size(); ++i)
    if (fixed[i] == 0 && space.points()(i, 1) <= 1e-12) problem.contact.push_back(i);
  problem.lower = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.contact.size()));
  return problem;
}

TEST(ManyBounds, BothRoadsAgreeOnAStiffLayerUnderBounds) {
  for (const std::string name : {"P1", "CR"})
    for (const bool structured : {true, false})
      for (const double epsilon : {1.0, 1e-3, 1e-6, 0.0}) {  // compliance 1, 1e-6, 1e-12, 0
        const TriangleMesh mesh = structured ? structured_mesh(8) : jittered_mesh(8, 0.2);
        VariationalInequality problem = layer_under_bounds(mesh, name, epsilon);
        const Eigen::VectorXd ones = Eigen::VectorXd::Ones(problem.lower.size());
        for (const double lower : {-10.0, -0.01, 0.0, 0.02}) {  // nowhere, in part, on the rest state, lifted
          problem.lower = lower * ones;
          const Outcome dense = by(ContactRoad::dense, problem), sparse = by(ContactRoad::sparse, problem);
          const std::string what = fmt::format("{} {} epsilon {} lower {}", name, structured, epsilon, lower);
          ASSERT_EQ(dense.refusal.empty(), sparse.refusal.empty()) << what << dense.refusal << sparse.refusal;
          if (!dense.refusal.empty()) continue;
          EXPECT_LE(apart(dense.s, sparse.s), 1e-10) << what;
          EXPECT_EQ(dense.s.warning.empty(), sparse.s.warning.empty()) << what;
        }
      }
}

TEST(ManyBounds, BothRoadsFindTheSameDiscUnderAMembrane) {
  const VariationalInequality problem = membrane_over_obstacle(28);
  const Outcome dense = by(ContactRoad::dense, problem), sparse = by(ContactRoad::sparse, problem);
  ASSERT_EQ(dense.refusal + sparse.refusal, "");
  EXPECT_EQ(dense.s.active, sparse.s.active);
  EXPECT_LE(apart(dense.s, sparse.s), 1e-13);
  EXPECT_LE((dense.s.lambda - sparse.s.lambda).lpNorm<Eigen::Infinity>(), 1e-12 * dense.s.lambda.maxCoeff());
  EXPECT_EQ(dense.s.counters.factorisations, 1);
  std::vector<bool> mixed(problem.bound_count());
  for (std::size_t i = 0; i < mixed.size(); i += 2) mixed[i] = true;
  ActiveSetOptions options;
  options.road = ContactRoad::sparse;
  options.start = test::held_at_lower(mixed);
  EXPECT_LE(apart(sparse.s, active_set(problem, options)), 1e-13) << "any start ends there";
}

// Between two obstacles: the membrane is pressed on the lower one on the left and on the upper one on the right; a few
// unknowns are equations, others bounded from above alone.
TEST(ManyBounds, BothRoadsAgreeBetweenTwoObstacles) {
  VariationalInequality problem = membrane_over_obstacle(28);
  problem.upper = problem.lower.array() + 0.3;
  for (int i = 0; i < problem.size(); ++i) {
    problem.load(i) *= i % 27 < 13 ? 3 : -3;
    if (i % 50 == 7) problem.upper(i) = problem.lower(i);
    if (i % 31 == 5) problem.lower(i) = -infinity;
    if (i % 31 == 6) problem.upper(i) = infinity;
  }
  const Outcome dense = by(ContactRoad::dense, problem), sparse = by(ContactRoad::sparse, problem);
  ASSERT_EQ(dense.refusal + sparse.refusal, "");
  EXPECT_GT(dense.s.lambda.maxCoeff(), 0);
  EXPECT_LT(dense.s.lambda.minCoeff(), 0);
  EXPECT_EQ(dense.s.active, sparse.s.active);
  EXPECT_LE(apart(dense.s, sparse.s), 1e-12);
  EXPECT_LE((dense.s.lambda - sparse.s.lambda).lpNorm<Eigen::Infinity>(), 1e-11 * dense.s.lambda.maxCoeff());
}

// All bounds hold, none does, they graze: u is the obstacle, which is its own solution.
TEST(ManyBounds, DegenerateContactIsTheSameByBothRoads) {
  VariationalInequality problem = membrane_over_obstacle(16);
  const Eigen::VectorXd grazing = problem.a1 * problem.lower;  // u = lower with no force
  for (const double push : {-1.0, 0.0, 1e-13, 1.0}) {
    problem.load = grazing + push * Eigen::VectorXd::Ones(problem.size());
    const Outcome dense = by(ContactRoad::dense, problem), sparse = by(ContactRoad::sparse, problem);
    ASSERT_EQ(dense.refusal + sparse.refusal, "") << push;
    EXPECT_LE(apart(dense.s, sparse.s), 1e-12) << push;
    if (push == -1) {
      EXPECT_EQ(std::count(sparse.s.active.begin(), sparse.s.active.end(), true), problem.size());
    }
  }
  problem.load.setZero();
  problem.lower.setZero();
  for (const ContactRoad road : {ContactRoad::dense, ContactRoad::sparse}) {
    const Outcome rest = by(road, problem);
    EXPECT_TRUE(rest.s.u.isZero(0));
    EXPECT_EQ(rest.s.active, std::vector<bool>(problem.size(), false)) << "no bound holds where nothing pushes";
    EXPECT_EQ(rest.s.counters.contact, 1);
  }
}

// From no contact and from contact everywhere the steps grow like 1/h (26 and 45 at 1/h = 128); nested they hardly do.
TEST(ManyBounds, TheNestedStartKeepsTheStepsFew) {
  for (const int n : {32, 64, 128}) {
    const Outcome o = by(ContactRoad::automatic, membrane_over_obstacle(n));
    ASSERT_EQ(o.refusal, "");
    EXPECT_LE(o.s.counters.contact, 9) << n;  // measured: 4, 4, 6
    if (n > 45) {                             // beyond 2000 bounds the start factors smaller matrices of its own
      EXPECT_EQ(o.s.counters.factorisations, o.s.counters.contact + 1) << n;
    }
    EXPECT_EQ(o.s.warning, "");
  }
}

/// Every unknown is bounded.
Pieces nested_start_of(const VariationalInequality& problem) {
  HeldFactor k;
  EXPECT_FALSE(k.factorise(SparseMatrix(problem.a1.triangularView<Eigen::Upper>())));
  return SparseContact(k, problem.load, problem.contact).nested_start({problem.lower}, 100);
}

TEST(ManyBounds, TheNestedStartIsMostOfTheContactSetAndLittleElse) {
  const VariationalInequality problem = membrane_over_obstacle(28);
  const Pieces start = nested_start_of(problem);
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
  EXPECT_EQ(nested_start_of(small), Pieces(small.size(), Piece::between));
}

// All of the membrane lies on the floor but where the floor has a hole: a start must not hold what no bound bears, in
// whatever aggregate the hole is.
TEST(ManyBounds, TheNestedStartHoldsNoBoundThatIsNotThere) {
  VariationalInequality problem = membrane_over_obstacle(28);
  for (const int hole : {0, 29}) {
    problem.lower.setZero();
    problem.lower(hole) = -infinity;
    const Pieces start = nested_start_of(problem);
    EXPECT_FALSE(is_active(start[hole])) << hole;
    EXPECT_GT(std::count(start.begin(), start.end(), Piece::at_lower), 700) << hole;  // of 729
  }
}

TEST(ManyBounds, AHeldFactorCountsTheSetsThatItFactors) {
  HeldFactor k;
  ASSERT_FALSE(k.factorise(SparseMatrix(membrane_over_obstacle(4).a1.triangularView<Eigen::Upper>())));
  std::vector<char> held(9, 0);
  k.hold(held);
  EXPECT_EQ(k.factorisations(), 1);
  held[4] = 1;
  k.hold(held);
  k.hold(held);
  EXPECT_EQ(k.factorisations(), 2);
}

TEST(ManyBounds, OneFactorServesASweepOverLoadsBoundsAndCompliances) {
  VariationalInequality problem = layer_under_bounds(structured_mesh(8), "P1", 0.0);
  PenaltyFactor factor(problem, 1e-4, ContactRoad::sparse);
  for (const double compliance : {0.0, 1e-12, 1e-6})
    for (const double size : {1.0, -3.0}) {
      VariationalInequality other = problem;
      other.compliance = compliance;
      other.load *= size;
      other.lower.array() -= 0.001 * std::abs(size);
      const Outcome alone = by(ContactRoad::dense, other);
      ASSERT_EQ(alone.refusal, "");
      EXPECT_LE(apart(alone.s, active_set(other, factor)), 1e-10) << compliance << " " << size;
    }
}

TEST(ManyBounds, TheLibraryChoosesTheRoad) {
  EXPECT_NE(PenaltyFactor(membrane_over_obstacle(12)).held(), nullptr);  // 121 bounds, all of the unknowns
  EXPECT_EQ(PenaltyFactor(membrane_over_obstacle(10)).held(), nullptr);  // 81
  const TriangleMesh mesh = structured_mesh(64);                         // bounds on a line
  EXPECT_EQ(PenaltyFactor(test::stiff_problem(Space(mesh, p1()), 0.1)).held(), nullptr);
}

TEST(ManyBounds, WhatIsWrongIsRefusedHereToo) {
  VariationalInequality problem = membrane_over_obstacle(28);
  PenaltyFactor factor(problem);
  ActiveSetOptions one;
  one.max_steps = 1;
  EXPECT_THROW(active_set(problem, factor, one), NotConverged);
  expect_refused([&] { uzawa(problem, factor); }, "accepted: a factor made with ContactRoad::dense");
  expect_refused([&] { factor.dense().forward(problem.load); }, "ContactRoad::dense");
  const auto refused = [&](const auto& spoil, const std::string& words) {
    VariationalInequality bad = problem;
    spoil(bad);
    expect_refused([&] { active_set(bad, factor); }, words);
  };
  using P = VariationalInequality;
  refused([](P& p) { p.contact.pop_back(), p.lower.conservativeResize(p.lower.size() - 1); },
          "free and contact unknowns");
  problem.a1.coeffRef(0, 1) = 3;
  expect_refused([&] { active_set(problem); }, "not symmetric");

  VariationalInequality floating = membrane_over_obstacle(28);  // each row sums to 0: held by nothing
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
  infeasible.lower(364) = 0.05;
  EXPECT_THROW(active_set(infeasible), NotConverged);
}

// ==== Bounds that give way: Tresca's friction, and plastic obstacles. Sticks where |lambda| < g, slips where |lambda| = g.

/// Up to six unknowns with a stiff row, contact, friction, plastic obstacles and combinations.
VariationalInequality random_friction(std::mt19937& engine) {
  std::normal_distribution<double> normal;
  const int n = 4 + static_cast<int>(engine() % 3), bounds = 2 + static_cast<int>(engine() % 3);
  const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(n, n, [&](auto, auto) { return normal(engine); });
  Eigen::MatrixXd a1 = root * root.transpose();
  a1 = 0.5 * (a1 + a1.transpose().eval()) + 0.1 * Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd b = Eigen::MatrixXd::NullaryExpr(1, n, [&](auto, auto) { return normal(engine); });
  VariationalInequality problem = small_problem(a1, Eigen::VectorXd::Zero(n), {}, b);
  problem.compliance = std::vector{0.0, 1e-20, 1e-3, 1.0}[engine() % 4];
  problem.load = Eigen::VectorXd::NullaryExpr(n, [&](auto) { return normal(engine); });
  const int rows = n >= bounds + 2 && engine() % 2 == 0 ? 1 : 0;
  for (int i = 0; i < bounds; ++i) problem.contact.push_back(i);
  Eigen::MatrixXd combination = Eigen::MatrixXd::Zero(rows, n);
  if (rows > 0) combination.row(0).tail(2) << 3 * normal(engine), normal(engine);
  problem.combinations = combination.sparseView();
  problem.lower = Eigen::VectorXd::NullaryExpr(bounds + rows, [&](auto) { return -0.2 * std::abs(normal(engine)); });
  problem.upper = problem.force_bound = Eigen::VectorXd::Constant(bounds + rows, infinity);
  for (int i = 0; i < bounds + rows; ++i) {
    if (engine() % 4 == 0) {  // contact, or an equation
      if (engine() % 2 == 0) problem.upper(i) = problem.lower(i);
      continue;
    }
    if (engine() % 4 == 0) continue;  // contact
    problem.force_bound(i) = 0.7 * std::abs(normal(engine));
    if (engine() % 4 == 0) continue;                               // a plastic obstacle
    problem.upper(i) = problem.lower(i) = engine() % 3 ? 0 : 0.1;  // friction, about 0 or elsewhere
    if (engine() % 5 == 0) problem.upper(i) += 0.05;               // with play
  }
  return problem;
}

TEST(Friction, IsRightBesideContactInHundredsOfSmallProblems) {
  std::mt19937 engine(7);
  int slips = 0, sticks = 0;
  for (int trial = 0; trial < 400; ++trial) {
    SCOPED_TRACE(trial);
    const VariationalInequality problem = random_friction(engine);
    VariationalInequality limit = problem;  // brute force sums A1 and B' M B / compliance: 1e-20 is 0 to all digits
    if (problem.compliance == 1e-20) limit.compliance = 0;
    const test::BruteForce truth = test::brute_force(limit);
    const double size = truth.u.lpNorm<Eigen::Infinity>();
    ActiveSetOptions sparse;
    sparse.road = ContactRoad::sparse;
    std::vector<Solution> answers{active_set(problem)};
    if (problem.combinations.rows() == 0) answers.push_back(active_set(problem, sparse));
    if (trial % 4 == 0) answers.push_back(uzawa(problem));
    for (const Solution& s : answers) {
      EXPECT_LT((s.u - truth.u).lpNorm<Eigen::Infinity>(), 1e-7 * size) << s.solver;
      EXPECT_LT((s.lambda - truth.lambda).lpNorm<Eigen::Infinity>(), 1e-6) << s.solver;
      EXPECT_LT(worst_violation(s.kkt), 1e-8) << s.solver;
    }
    for (Eigen::Index i = 0; i < truth.lambda.size(); ++i) {
      if (std::isinf(problem.force_bound(i))) continue;
      const bool slipped = std::abs(truth.lambda(i)) >= problem.force_bound(i) * (1 - 1e-12);
      ++(slipped ? slips : sticks);
      EXPECT_EQ(answers[0].active[i], truth.active[i]) << i;
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
    EXPECT_LE(errors.back(), 1.0 / (8 * n * n)) << n;  // the end of the slip lies within a cell: h^2 / 8
    EXPECT_LT((uzawa(bar).u - s.u).lpNorm<Eigen::Infinity>(), 1e-8);
    EXPECT_NEAR(s.lambda.sum(), -pull, 1e-12);  // the floor bears all
    for (Eigen::Index i = 0; i < s.lambda.size(); ++i)
      EXPECT_EQ(s.active[i], s.lambda(i) > -bar.force_bound(i)) << "sticks where it bears less than it can";
    EXPECT_LE(s.counters.contact, 8);
  }
}

// The pull is what one node bears, or all of them together: lambda = -g where u = 0, to the last bit.
TEST(Friction, ABoundThatBearsExactlyItsMostIsNoTrouble) {
  for (const int n : {2, 8, 64})
    for (const double pull : {0.5 / n, 1.5 / n, 2.5 / n, (n - 0.5) / n}) {
      const VariationalInequality bar = bar_on_a_floor(n, pull);
      std::vector<Solution> answers{active_set(bar)};
      if (pull * n > 1) answers.push_back(uzawa(bar));  // where all sticks u = 0: its step is never small beside u
      for (const Solution& s : answers) {
        const int slips = static_cast<int>(std::lround(pull * n - 0.5));  // nodes beyond the one that just sticks
        for (int i = 0; i + slips < n; ++i) EXPECT_NEAR(s.u(i), 0, 1e-9) << s.solver << n << ' ' << pull;
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
  EXPECT_EQ(friction_energy(bar, still.u), 0);
  EXPECT_EQ(slack(bar, s.u).minCoeff(), infinity);  // what gives way leaves every u admissible
  EXPECT_NEAR(friction_energy(bar, Eigen::VectorXd::Ones(21)), 1 - 0.5 / 20, 1e-14);  // 21 terms
}

// g = 0 is no bound at all, g = infinity an equation, and a great g holds like one.
TEST(Friction, LimitsAreTheProblemsWithoutIt) {
  VariationalInequality bar = bar_on_a_floor(20, 0.53);
  VariationalInequality free = bar;
  free.contact.clear();
  free.lower.resize(0);
  free.upper = free.force_bound = free.lower;
  bar.force_bound.setZero();
  for (const Solution& s : {active_set(bar), uzawa(bar)})
    EXPECT_LT((s.u - active_set(free).u).lpNorm<Eigen::Infinity>(), 1e-12) << s.solver;
  for (const double most : {1e3, 1e12, infinity}) {
    bar.force_bound.setConstant(most);
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
    DenseContact system(random.s, random.q);
    const Pieces start(n, trial % 2 == 1 ? Piece::at_lower : Piece::between);
    const ContactAnswer answer = solve_contact(system, {random.lower, upper, most}, start, 300);
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
  const auto count = membrane.lower.size();
  membrane.lower.setZero();  // every vertex is held in a paste that yields
  membrane.upper = membrane.lower;
  membrane.force_bound = Eigen::VectorXd::Constant(count, 4.0 / (30 * 30));
  ActiveSetOptions dense, sparse;
  dense.road = ContactRoad::dense;
  sparse.road = ContactRoad::sparse;
  const Solution one = active_set(membrane, dense), other = active_set(membrane, sparse);
  EXPECT_LT((one.u - other.u).lpNorm<Eigen::Infinity>(), 1e-11);
  EXPECT_EQ(one.active, other.active);
  membrane.force_bound.head(count / 2).setConstant(20.0 / (30 * 30));  // half of it bears all of its load and more
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
    EXPECT_LT((s.u - limit.u).lpNorm<Eigen::Infinity>(), epsilon + 1e-12) << epsilon;  // measured 0.05 epsilon
    EXPECT_LE(s.counters.corrections, 5);
    EXPECT_EQ(s.active, limit.active);
  }
  scene.friction = [](double at) { return 3 * at; };
  EXPECT_NEAR(assemble(scene, {x, y}).force_bound.tail(17).sum(), 1.5, 1e-14);  // int g
  scene.friction = [](double) { return -1.0; };
  expect_refused([&] { assemble(scene, {x, y}); }, "friction bound -1");
}

TEST(Friction, ASweepOverItsBoundIsTheSameAsEachAlone) {
  Sweep sweep(bar_on_a_floor(40, 0.53));
  for (const double factor : {1.0, 0.6, 2.0, 0.0, 1.0}) {
    VariationalInequality alone = bar_on_a_floor(40, 0.53);
    alone.force_bound *= factor;
    sweep.set_force_bound(alone.force_bound);
    const Solution s = sweep.solve();
    EXPECT_LT((s.u - active_set(alone).u).lpNorm<Eigen::Infinity>(), 1e-13) << factor;
  }
  EXPECT_EQ(sweep.total().factorisations, 1);
  expect_refused([&] { sweep.set_force_bound(Eigen::VectorXd::Constant(40, -1)); }, "force_bound 0 is -1");
  EXPECT_LT((sweep.solve().u - active_set(bar_on_a_floor(40, 0.53)).u).lpNorm<Eigen::Infinity>(), 1e-13) << "as before";
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
    bad.force_bound = Eigen::VectorXd::Constant(size, value);
    for (const auto& solve : {+[](const VariationalInequality& p) { return active_set(p); },
                              +[](const VariationalInequality& p) { return uzawa(p); }})
      expect_refused([&] { solve(bad); }, words);
  };
  refused(-1, 4, "force_bound 0 is -1");
  refused(nan, 4, "force_bound 0 is nan");
  refused(1, 3, "force_bound has 3 entries; accepted none, or 4");
  const SpaceOn space(structured_mesh(2), p1());
  expect_refused([&] { contact_zone(space, good, active_set(good)); }, "friction is not known here");
  expect_refused([&] { require_lower_bounds(good, "certificate"); }, "certificate: friction is not known here");
  ActiveSetOptions options;
  options.start = Pieces(3, Piece::between);
  expect_refused([&] { active_set(good, options); }, "3 pieces; accepted one per bound, 4");
  VariationalInequality loose = good;  // nothing but friction holds it: its A1 is singular
  loose.fixed.clear();
  loose.fixed_values.resize(0);
  expect_refused([&] { active_set(loose); }, "held by nothing");
}

// Friction takes part in no infeasibility, and hides none: B u = 0 says u_0 = 0, its hard bound says 0.05.
TEST(Friction, AnInfeasibleProblemIsRefusedWithFrictionToo) {
  VariationalInequality problem = bar_on_a_floor(4, 0.3);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(1, 5);
  b(0, 1) = 1;
  problem.b = b.sparseView();
  problem.m = Eigen::VectorXd::Ones(1);
  problem.compliance = 0;
  problem.lower(0) = problem.upper(0) = 0.05;
  problem.force_bound(0) = infinity;
  EXPECT_THROW(active_set(problem), NotConverged);
  problem.force_bound(0) = 0.1;  // the same bound, but it gives way
  EXPECT_NEAR(active_set(problem).u(1), 0, 1e-12);
  EXPECT_NEAR(active_set(problem).lambda(0), 0.1, 1e-12);
}

}  // namespace antilock::test::solve_test
