// Degenerate contact: all, none, one, grazing, many zones, every start, every scale; no endless
// loop.
#include "antilock/core/dense.hpp"
#include "antilock/exact/exact_solution.hpp"
#include "antilock/solve/contact_systems.hpp"
#include "hard/quad_reference.hpp"
#include "support/random_contact.hpp"
#include "support/scenes.hpp"
#include "support/small_problem.hpp"

namespace antilock::hard::degenerate_contact_test {

using std::numbers::pi;

int count(const std::vector<bool>& active) {
  return static_cast<int>(std::count(active.begin(), active.end(), true));
}

/// Runs of neighbours in contact.
int zones(const std::vector<bool>& active) {
  int runs = 0;
  for (std::size_t i = 0; i < active.size(); ++i) runs += active[i] && (i == 0 || !active[i - 1]);
  return runs;
}

/// Element and epsilon: every property below holds for each pair on a structured mesh.
class Degenerate : public testing::TestWithParam<std::tuple<const char*, double>> {
 protected:
  VariationalInequality problem(const Space& space, const Field& load,
                                std::optional<UnilateralContact> contact) const {
    return assemble(Scene({load}, StiffLayer{std::get<1>(GetParam())}, std::move(contact)), space);
  }
  VariationalInequality problem(
      const Space& space, const Field& load,
      const Profile& gap = [](double) { return 0.0; }) const {
    return problem(space, load, UnilateralContact{gap});
  }
  /// Solves, and has quadruple precision prove the answer right: 1e-9 is the solver's promise. The
  /// contact set may differ from the exact one where gap and pressure vanish together; u may not.
  static Solution proved(const VariationalInequality& problem,
                         const ActiveSetOptions& options = {}) {
    Solution solution = active_set(problem, options);
    EXPECT_TRUE(solution.warning.empty()) << solution.warning;
    EXPECT_LE(solution.counters.contact_iterations, 40) << "contact steps in one correction";
    RefinedReference reference;
    const QuadSolution exact = settle(problem, solution.active, std::ref(reference));
    EXPECT_LT(exact.residual, 1e-20);
    EXPECT_GE(std::min(exact.min_gap, exact.min_pressure), -1e-18);
    EXPECT_LT(distance(solution.u, exact.u), 1e-9);
    return solution;
  }
  const Element& chosen() const { return element(std::get<0>(GetParam())); }
  Space space_{structured_mesh(32), chosen()};
};

TEST_P(Degenerate, EverythingInContactUpToTheClampedCorners) {
  const Solution s = proved(problem(space_, [](double, double) { return -10.0; }));
  EXPECT_EQ(count(s.active), static_cast<int>(s.active.size()));
  EXPECT_GT(s.lambda.minCoeff(), 0);
}

TEST_P(Degenerate, NothingInContactIsTheProblemWithoutContact) {
  const auto up = [](double, double) { return 10.0; };
  const Solution s = proved(problem(space_, up));
  EXPECT_EQ(count(s.active), 0);
  EXPECT_EQ(s.lambda.lpNorm<Eigen::Infinity>(), 0);
  const Solution free = active_set(problem(space_, up, std::nullopt));
  EXPECT_LT(test::relative_difference(s.u, free.u), 2e-10);  // twice the tolerance
}

TEST_P(Degenerate, ContactUpToOneCornerOnly) {
  const Solution s =
      proved(problem(space_, [](double x, double) { return x < 0.5 ? -10.0 : 10.0; }));
  EXPECT_TRUE(s.active.front());
  EXPECT_FALSE(s.active.back());
  EXPECT_EQ(zones(s.active), 1);
}

TEST_P(Degenerate, ContactAtOneUnknownOfMany) {
  const double x = space_.dof_coordinates()(space_.contact_dofs()[11], 0);
  const Solution s = proved(problem(
      space_, [](double, double) { return -10.0; },
      [&](double at) { return at == x ? 0.0 : 10.0; }));
  EXPECT_EQ(count(s.active), 1);
  EXPECT_TRUE(s.active[11]);
  EXPECT_GT(s.lambda(11), 0);
}

TEST_P(Degenerate, AProblemWithOneContactUnknown) {
  const Space space(structured_mesh(chosen().name() == "P1" ? 2 : 1), chosen());
  ASSERT_EQ(space.contact_dofs().size(), 1u);
  for (const double sign : {-1.0, 1.0}) {
    const Solution s = proved(problem(space, [&](double, double) { return sign; }));
    EXPECT_EQ(s.active[0], sign < 0);
  }
}

// The obstacle has the shape of the free solution on an interval: gap and pressure are both zero
// there, and no sign of either means anything. One round-off up or down, it is grazing or pressed
// by nothing.
TEST_P(Degenerate, GrazingContactHasTheFreeSolutionAndNoForce) {
  const Solution free = active_set(problem(space_, paper_load, std::nullopt));
  for (const double nudge : {0.0, 1e-16, -1e-16, 1e-13, -1e-13}) {
    VariationalInequality grazing = problem(space_, paper_load);
    for (Eigen::Index i = 0; i < grazing.bounds.lower.size(); ++i) {
      const double x = space_.dof_coordinates()(grazing.bounds.unknowns[i], 0),
                   u = free.u(grazing.bounds.unknowns[i]);
      grazing.bounds.lower(i) = x > 0.3 && x < 0.8 ? u + nudge : u - 1;
    }
    const Solution s = proved(grazing);
    EXPECT_LT(test::relative_difference(s.u, free.u), 1e-9) << nudge;
    EXPECT_LT(s.lambda.lpNorm<Eigen::Infinity>(), 1e-8 * grazing.load.lpNorm<Eigen::Infinity>())
        << nudge;
  }
}

// At epsilon = 1 a wave of the load arrives at Gamma_C as exp(-2 k pi) of itself, far below the
// discretisation error: the zones are then the mesh's own, and the algebra is right all the same.
TEST_P(Degenerate, SeveralZonesAreThoseOfTheTruth) {
  const double epsilon = std::get<1>(GetParam());
  const Solution s =
      proved(problem(space_, [](double x, double) { return 10 * std::sin(6 * pi * x); }));
  if (epsilon == 1) return;
  EXPECT_EQ(zones(s.active), 3);
  EXPECT_EQ(ExactSolution(SineLoad{{{6, {10.0}}}}, epsilon, true, 12).contact_zones().size(), 3u);
}

TEST_P(Degenerate, ARapidLoadHasOneZoneAWave) {
  const Space space(structured_mesh(128), chosen());
  const Solution s =
      active_set(problem(space, [](double x, double) { return 100 * std::sin(32 * pi * x); }));
  EXPECT_TRUE(s.warning.empty());
  EXPECT_LE(s.counters.contact_iterations, 40);
  EXPECT_LE(s.counters.corrections, 10);
  if (std::get<1>(GetParam()) < 1) {
    EXPECT_EQ(zones(s.active), 16);
  }
}

TEST_P(Degenerate, NoLoadMovesNothingAndNeedsNoCorrection) {
  const Solution s = active_set(problem(space_, [](double, double) { return 0.0; }));
  EXPECT_EQ(s.u.lpNorm<Eigen::Infinity>(), 0);
  EXPECT_EQ(s.p.lpNorm<Eigen::Infinity>(), 0);
  EXPECT_EQ(s.lambda.lpNorm<Eigen::Infinity>(), 0);
  EXPECT_EQ(s.counters.corrections, 0);
  EXPECT_EQ(worst_violation(s.kkt), 0);
}

// No absolute number anywhere in the solver: multiplying load and bounds by a power of two
// multiplies the answer by it, bit for bit, over 600 binary orders of magnitude.
TEST_P(Degenerate, TheAnswerScalesWithTheLoadBitForBit) {
  for (const double gap : {0.0, 0.01}) {
    const VariationalInequality one = problem(space_, paper_load, [&](double) { return gap; });
    const Solution unit = proved(one);
    for (const int exponent : {-300, -40, -1, 1, 40, 300}) {
      VariationalInequality scaled = one;
      const double factor = std::ldexp(1.0, exponent);
      scaled.load *= factor;
      scaled.bounds.lower *= factor;
      const Solution s = active_set(scaled);
      EXPECT_EQ(s.u, factor * unit.u) << exponent;
      EXPECT_EQ(s.lambda, factor * unit.lambda) << exponent;
      EXPECT_EQ(s.p, factor * unit.p) << exponent;
      EXPECT_EQ(s.active, unit.active);
      EXPECT_EQ(s.counters.corrections, unit.counters.corrections);
    }
  }
}

TEST_P(Degenerate, ObstaclesAwayPressedInAndUneven) {
  // the clamp holds u = 0 at both ends, so no obstacle may press in there
  for (const Profile& gap : std::vector<Profile>{
           [](double) { return 0.01; }, [](double x) { return -0.01 * std::sin(pi * x); },
           [](double x) { return -10 * x * (1 - x); }, [](double) { return 1e6; },
           [](double x) { return 0.02 * std::sin(9 * pi * x) * std::sin(pi * x); },
           [](double x) { return x < 0.5 ? 1e9 : 0.0; },
           [](double x) { return std::abs(x - 0.7) - 0.05; }}) {
    const Solution s = proved(problem(space_, paper_load, gap));
    for (std::size_t i = 0; i < s.active.size(); ++i)
      if (s.active[i]) {
        EXPECT_EQ(s.u(space_.contact_dofs()[i]),
                  -gap(space_.dof_coordinates()(space_.contact_dofs()[i], 0)));
      }
  }
}

TEST_P(Degenerate, TheWorstStartsEndInTheSameAnswer) {
  const VariationalInequality paper = problem(space_, paper_load);
  const Solution best = proved(paper);
  const std::size_t c = paper.bounds.unknowns.size();
  std::vector<bool> alternating(c), opposite = best.active;
  for (std::size_t i = 0; i < c; ++i) alternating[i] = i % 2 == 0;
  opposite.flip();
  for (const std::vector<bool>& start :
       {std::vector<bool>(c, true), std::vector<bool>(c, false), alternating, opposite}) {
    ActiveSetOptions options;
    options.start = test::held_at_lower(start);
    const Solution s = proved(paper, options);
    EXPECT_EQ(s.active, best.active);
    EXPECT_LT(test::relative_difference(s.u, best.u), 1e-9);
  }
}

std::string case_name(const testing::TestParamInfo<Degenerate::ParamType>& info) {
  const double epsilon = std::get<1>(info.param);
  return std::get<0>(info.param) + std::string("Epsilon") +
         (epsilon == 1     ? "1"
          : epsilon > 1e-3 ? "1em2"
          : epsilon > 0    ? "1em8"
                           : "0");
}
INSTANTIATE_TEST_SUITE_P(Paper, Degenerate,
                         testing::Combine(testing::Values("P1", "CR"),
                                          testing::Values(1.0, 1e-2, 1e-8, 0.0)),
                         case_name);

/// The plain primal-dual active set: true where it settles, false where a set comes back.
bool plain_settles(const Eigen::MatrixXd& s, const Eigen::VectorXd& q) {
  std::vector<bool> active(q.size(), false);
  std::set<std::vector<bool>> tried;
  while (tried.insert(active).second) {
    std::vector<int> free;
    for (int i = 0; i < q.size(); ++i)
      if (!active[i]) free.push_back(i);
    Eigen::VectorXd v = Eigen::VectorXd::Zero(q.size());
    if (!free.empty()) {
      const Eigen::VectorXd x = Cholesky(s(free, free)).solve(Eigen::VectorXd(q(free)));
      v(free) = x;
    }
    const Eigen::VectorXd lambda = s * v - q;
    bool settled = true;
    for (int i = 0; i < q.size(); ++i)
      if (active[i] ? lambda(i) < -1e-12 : v(i) < -1e-12) {
        active[i] = !active[i];
        settled = false;
      }
    if (settled) return true;
  }
  return false;
}

/// Notes every v that solve_contact moves from.
class Watched : public ContactSystem {
 public:
  explicit Watched(SchurComplementContact& system)
      : ContactSystem(system.bounded()), system_(system) {}
  FixedStatusSolution solve(const std::vector<char>& active,
                            const Eigen::VectorXd& prescribed) override {
    FixedStatusSolution now = system_.solve(active, prescribed);
    w_ = now.v;
    return now;
  }
  double energy_norm_squared(const Eigen::VectorXd& way) const override {
    if (w_.size() > 0) from.emplace_back(w_ - way);
    w_.resize(0);  // asked again of the same w: how far to go
    return system_.energy_norm_squared(way);
  }
  BoundStatuses nested_start(const ShiftedBounds& bounds, int max_iterations) override {
    return system_.nested_start(bounds, max_iterations);
  }
  mutable std::vector<Eigen::VectorXd> from;

 private:
  SchurComplementContact& system_;
  mutable Eigen::VectorXd w_;
};

// Off Gamma_C of an elastic body nothing promises that the plain method ends: for a random
// symmetric positive definite matrix it cycles now and then. The safeguarded one ends every time,
// with every condition met, and J = v' S v / 2 - q' v never rises on its way once v stands above
// its bounds, whatever it was let go from.
TEST(Cycling, RandomComplementarityProblemsAllEnd) {
  test::RandomContact contact;
  int cycles = 0, most = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    contact.next();
    const int n = contact.size();
    const Eigen::MatrixXd& s = contact.s;
    const Eigen::VectorXd &q = contact.q, &lower = contact.lower;
    SchurComplementContact dense(s, q);
    Watched watched(dense);
    ConstrainedCholesky k;
    ASSERT_FALSE(k.factorise(Eigen::MatrixXd(s.triangularView<Eigen::Upper>()).sparseView()));
    std::vector<int> bounded(n);
    std::iota(bounded.begin(), bounded.end(), 0);
    SparseContact sparse(k, q, bounded);
    cycles += !plain_settles(s, q);
    for (const bool start : {false, true})
      for (ContactSystem* system :
           {static_cast<ContactSystem*>(&watched), static_cast<ContactSystem*>(&sparse)}) {
        const ContactResult answer = solve_contact(
            *system, BoundLimits(lower),
            BoundStatuses(n, start ? BoundStatus::at_lower : BoundStatus::inactive), 500);
        most = std::max(most, answer.steps);
        // relative to the condition number, 1e7 at most: 64 round-offs of S v moved by S^-1
        const double v_scale = answer.v.lpNorm<Eigen::Infinity>(),
                     f_scale = s.cwiseAbs().maxCoeff() * v_scale + 1;
        EXPECT_GE(answer.v.minCoeff(), -1e-6 * v_scale) << trial;
        EXPECT_GE((s * answer.v - q).minCoeff(), -1e-10 * f_scale) << trial;
        EXPECT_LE(answer.v.cwiseProduct(answer.lambda).lpNorm<Eigen::Infinity>(),
                  1e-10 * v_scale * f_scale)
            << trial;
        double before = test::infinity;
        for (const Eigen::VectorXd& v : std::exchange(watched.from, {})) {
          const double j = v.dot(s * v) / 2 - q.dot(v),
                       terms = v.cwiseAbs().dot(s.cwiseAbs() * v.cwiseAbs());
          EXPECT_LE(j, before + 2e-15 * terms) << trial;  // measured: 1.2e-16
          if (v.minCoeff() >= 0) before = j;
        }
      }
  }
  EXPECT_GE(cycles, 3) << "the plain method must cycle somewhere, else this test tests nothing";
  RecordProperty("plain_cycles", cycles);
  RecordProperty("most_steps", most);
  EXPECT_LE(most, 200);
}

// A bound held by the neighbour's force lets go under a pull of 5e-11 of the forces there: that is
// no round-off, 1e-14.
TEST(Cycling, APullFarBelowTheForcesLetsGo) {
  const Eigen::MatrixXd s = test::chain(2);
  for (const double off : {1e-6, 1e-10}) {
    const Eigen::VectorXd q = Eigen::Vector2d(off - 1, -5), lower = Eigen::Vector2d(0, 1);
    SchurComplementContact dense(s, q);
    ConstrainedCholesky k;
    ASSERT_FALSE(k.factorise(Eigen::MatrixXd(s.triangularView<Eigen::Upper>()).sparseView()));
    SparseContact sparse(k, q, {0, 1});
    for (ContactSystem* system :
         {static_cast<ContactSystem*>(&dense), static_cast<ContactSystem*>(&sparse)})
      EXPECT_NEAR(
          solve_contact(*system, BoundLimits(lower), BoundStatuses(2, BoundStatus::at_lower), 10)
              .v(0),
          off / 2, 1e-15);
  }
}

TEST(Cycling, TheCapIsAFailure) {
  const Eigen::MatrixXd s = Eigen::MatrixXd::Identity(4, 4);
  const Eigen::VectorXd q = Eigen::Vector4d(1, -1, 1, -1), lower = Eigen::Vector4d::Zero();
  SchurComplementContact system(s, q);
  const auto failure = test::thrown<NotConverged>([&] {
    solve_contact(system, BoundLimits(lower), BoundStatuses(4, BoundStatus::inactive), 1);
  });
  EXPECT_EQ(failure.steps, 1);
  EXPECT_DOUBLE_EQ(failure.reached, 0.5);
  EXPECT_EQ(
      solve_contact(system, BoundLimits(lower), BoundStatuses(4, BoundStatus::inactive), 2).steps,
      2);
}

}  // namespace antilock::hard::degenerate_contact_test
