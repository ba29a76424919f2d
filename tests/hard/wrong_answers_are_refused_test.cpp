// The checks that every solve passes, fed with wrong answers on purpose.
#include "antilock/analysis/hypotheses.hpp"
#include "support/scenes.hpp"

namespace antilock::test::wrong_answers_are_refused_test {

class WrongAnswers : public testing::TestWithParam<double> {
 protected:
  WrongAnswers()
      : space_(structured_mesh(16), crouzeix_raviart()),
        problem_(assemble(test::stiff_scene(GetParam()), space_)),
        solution_(active_set(problem_)) {}
  int first(bool active) const {
    for (std::size_t i = 0; i < solution_.active.size(); ++i)
      if (solution_.active[i] == active) return static_cast<int>(i);
    return -1;
  }
  Space space_;
  VariationalInequality problem_;
  Solution solution_;
};

TEST_P(WrongAnswers, TheRightAnswerIsTrustedWithoutAWarning) {
  EXPECT_TRUE(solution_.warning.empty());
  EXPECT_LT(worst_violation(solution_.kkt), 1e-10);
}

// Each fault is one that a solver can commit; each must be seen by the number that stands for its
// condition.
TEST_P(WrongAnswers, EveryKindOfWrongAnswerIsRefused) {
  ASSERT_GE(first(true), 0);
  ASSERT_GE(first(false), 0);
  const double u_scale = solution_.u.lpNorm<Eigen::Infinity>(),
               f_scale = problem_.load.lpNorm<Eigen::Infinity>();
  constexpr double inf = test::infinity, nan = test::nan;
  const std::vector<std::pair<std::string, std::function<void(Solution&)>>> faults{
      {"one unknown in the body moved",
       [&](Solution& s) { s.u(space_.size() - 1) += 1e-2 * u_scale; }},
      {"one unknown in contact moved",
       [&](Solution& s) { s.u(problem_.bounds.unknowns[first(false)]) += 1e-3 * u_scale; }},
      {"every unknown scaled", [](Solution& s) { s.u *= 1 + 1e-4; }},
      {"no answer at all", [](Solution& s) { s.u.setZero(), s.p.setZero(), s.lambda.setZero(); }},
      {"a locked layer",
       [&](Solution& s) {
         for (int i = 0; i < space_.size(); ++i)
           if (space_.dof_coordinates()(i, 1) <= 0) s.u(i) = 0;
       }},
      {"the layer stress forgotten", [](Solution& s) { s.p.setZero(); }},
      {"the layer stress scaled", [](Solution& s) { s.p *= 1.01; }},
      {"contact forces scaled", [](Solution& s) { s.lambda *= 0.9; }},
      {"contact forces turned", [](Solution& s) { s.lambda *= -1; }},
      {"the layer stress of one triangle", [](Solution& s) { s.p(s.p.size() / 2) *= 2; }},
      {"contact forces forgotten", [](Solution& s) { s.lambda.setZero(); }},
      {"a contact that pulls", [&](Solution& s) { s.lambda(first(true)) = -0.1 * f_scale; }},
      {"a force across a gap", [&](Solution& s) { s.lambda(first(false)) = 0.1 * f_scale; }},
      {"through the obstacle",
       [&](Solution& s) { s.u(problem_.bounds.unknowns[first(true)]) = -0.01 * u_scale; }},
      {"a clamp that slips", [&](Solution& s) { s.u(problem_.dirichlet_dofs[3]) = 1e-12; }},
      {"not a number in u", [&](Solution& s) { s.u(7) = nan; }},
      {"not a number in p", [&](Solution& s) { s.p(7) = nan; }},
      {"not a number in lambda", [&](Solution& s) { s.lambda(1) = nan; }},
      {"infinite u", [&](Solution& s) { s.u(7) = inf; }},
      {"infinite p", [&](Solution& s) { s.p(7) = -inf; }},
      {"infinite lambda", [&](Solution& s) { s.lambda(1) = inf; }}};
  for (const auto& [what, spoil] : faults) {
    Solution wrong = solution_;
    spoil(wrong);
    EXPECT_THROW(check_kkt(problem_, wrong), NotConverged) << what;
  }
}

TEST_P(WrongAnswers, WarnsBetweenTheTwoLevelsAndRefusesAbove) {
  Solution slightly = solution_;
  slightly.u *= 1 + 1e-8;
  check_kkt(problem_, slightly);
  EXPECT_NE(slightly.warning.find("trusted 1e-09"), std::string::npos) << slightly.warning;
  EXPECT_EQ(slightly.warning.find('\n'), std::string::npos) << "one line";
  Solution same = slightly;
  EXPECT_THROW(check_kkt(problem_, same, {1e-12, 1e-10}), NotConverged);
  same = slightly;
  same.warning.clear();
  check_kkt(problem_, same, {1e-3, 1e-2});
  EXPECT_TRUE(same.warning.empty());
  slightly.u *= 1.1;
  const auto refusal = thrown<NotConverged>([&] { check_kkt(problem_, slightly); });
  EXPECT_NE(std::string(refusal.what()).find("active set: answer refused"), std::string::npos)
      << refusal.what();
  EXPECT_NEAR(refusal.reached, worst_violation(kkt_report(problem_, slightly)), 1e-15);
  EXPECT_GT(refusal.reached, 1e-6);
}

// The terms of A1 u are h^-2 times larger than the forces they balance: an error must not hide
// behind them.
TEST_P(WrongAnswers, AWrongAnswerIsRefusedOnAFineMeshToo) {
  const Space space(structured_mesh(128), p1());
  const VariationalInequality problem = assemble(test::stiff_scene(GetParam()), space);
  Solution wrong = active_set(problem);
  EXPECT_TRUE(wrong.warning.empty());
  wrong.u *= 1 + 1e-5;
  EXPECT_THROW(check_kkt(problem, wrong), NotConverged);
}

// Scale-free: load and answer multiplied by a power of two give the same report bit for bit, right
// or wrong.
TEST_P(WrongAnswers, TheReportDoesNotSeeTheScaleOfTheLoad) {
  Solution wrong = solution_;
  wrong.u *= 1.0001;
  wrong.lambda(first(true)) *= -1;
  for (const Solution& answer : {solution_, wrong}) {
    const Kkt kkt = kkt_report(problem_, answer);
    for (const int exponent : {-300, -40, 40, 300}) {
      const double factor = std::ldexp(1.0, exponent);
      VariationalInequality problem = problem_;
      problem.load *= factor;
      problem.bounds.lower *= factor;
      Solution scaled = answer;
      scaled.u *= factor, scaled.p *= factor, scaled.lambda *= factor,
          scaled.penalised_max_u *= factor;
      const Kkt other = kkt_report(problem, scaled);
      EXPECT_EQ(kkt.residual, other.residual);
      EXPECT_EQ(kkt.min_gap, other.min_gap);
      EXPECT_EQ(kkt.min_pressure, other.min_pressure);
      EXPECT_EQ(kkt.complementarity, other.complementarity);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Epsilon, WrongAnswers, testing::Values(1.0, 1e-2, 1e-8, 0.0),
                         [](const auto& info) { return "Case" + std::to_string(info.index); });

/// n unknowns in a row with springs between neighbours.
SparseMatrix springs(const Eigen::VectorXd& stiffness) {
  const Eigen::Index n = stiffness.size() + 1;
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i + 1 < n; ++i)
    for (const Eigen::Index a : {i, i + 1})
      for (const Eigen::Index b : {i, i + 1})
        entries.emplace_back(a, b, a == b ? stiffness(i) : -stiffness(i));
  SparseMatrix a1(n, n);
  a1.setFromTriplets(entries.begin(), entries.end());
  return a1;
}

// A pivot of a singular matrix is round-off of either sign: a positive one does not make it
// regular.
TEST(Singular, AStructureThatNothingHoldsIsRefusedWhateverTheRoundOff) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::srand(seed);
    VariationalInequality problem;
    problem.a1 = springs(Eigen::VectorXd::Ones(19) + 0.9 * Eigen::VectorXd::Random(19));
    problem.b.resize(0, 20);
    problem.load = Eigen::VectorXd::Unit(20, 3);
    EXPECT_THROW(active_set(problem), Error) << "seed " << seed;
  }
}

/// Six unknowns in a row, the first held at 0, the second held at 0 by B and pressed to 0.1:
/// infeasible at compliance
/// 0. `far` is the bound of another, `unit` the unit in which a second row of B is written.
VariationalInequality impossible(double far, double unit) {
  VariationalInequality problem;
  problem.a1 = springs(Eigen::VectorXd::Ones(5));
  problem.b.resize(2, 6);
  problem.b.insert(0, 1) = 1;
  problem.b.insert(1, 4) = unit;
  problem.b.makeCompressed();
  problem.m = Eigen::Vector2d(1, 1 / (unit * unit));
  problem.compliance = 0;
  problem.load = Eigen::VectorXd::Constant(6, 0.01);
  problem.dirichlet_dofs = {0};
  problem.dirichlet_values = Eigen::VectorXd::Zero(1);
  problem.bounds = Bounds::lower_on({1, 3}, Eigen::Vector2d(0.1, far));
  return problem;
}

TEST(Impossible, IsSeenBesideAFarBoundAndInAnyUnits) {
  for (const double far : {0.0, -1e3, -1e6, -1e9}) {
    EXPECT_THROW(active_set(impossible(far, 1)), NotConverged) << far;
    EXPECT_GT(distance_to_kernel(impossible(far, 1)), 0.1) << far;
  }
  for (const double unit : {1e-6, 1e3, 1e9, 1e12}) {
    EXPECT_THROW(active_set(impossible(0, unit)), NotConverged) << unit;
    EXPECT_GT(distance_to_kernel(impossible(0, unit)), 0.1) << unit;
  }
}

TEST(Impossible, AFarBoundDoesNotHideABrokenCompliance) {
  for (const double far : {0.0, -1e3, -1e6, -1e9}) {
    VariationalInequality problem = impossible(far, 1);
    problem.bounds.lower(0) = -1;
    Solution foreign;  // of the problem without B: p = 0 although B u is not
    VariationalInequality soft = problem;
    soft.b.resize(0, 6);
    soft.m.resize(0);
    foreign.u = active_set(soft).u;
    foreign.p = Eigen::Vector2d::Zero();
    foreign.lambda = Eigen::Vector2d::Zero();
    EXPECT_GT(kkt_report(problem, foreign).residual, 0.1) << far;
    EXPECT_THROW(check_kkt(problem, foreign), NotConverged) << far;
  }
}

}  // namespace antilock::test::wrong_answers_are_refused_test
