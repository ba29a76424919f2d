#include "antilock/analysis/kernel.hpp"
#include "antilock/analysis/nearest.hpp"
#include "antilock/form/h1_norm.hpp"
#include "antilock/problem/bounds.hpp"
#include "antilock/problem/choose_penalty.hpp"
#include "antilock/problem/projected.hpp"
#include "support/platen.hpp"
#include "support/scenes.hpp"
#include "support/small_problem.hpp"

namespace antilock::test::problem_test {

// ==== Malformed problems are refused before any solver sees them.

TEST(ChoosePenalty, IsInTheUnitsOfCompliance) {
  // A1 times s: the same problem at compliance / s. B times s, or M times s^2: at compliance s^2.
  const TriangleMesh mesh = structured_mesh(8);
  const VariationalInequality problem = stiff_problem(Space(mesh, p1()), 0);
  const double delta = choose_penalty(problem);
  EXPECT_EQ(moderate_delta(problem), delta);
  EXPECT_EQ(moderate_delta(problem, 1e-3), 1e-3);
  for (const double s : {1e3, 1e6}) {
    VariationalInequality scaled = problem;
    scaled.b *= s;
    EXPECT_NEAR(choose_penalty(scaled) / (delta * s * s), 1, 1e-13);  // round-off of two ratios and their roots
    scaled = problem;
    scaled.a1 /= s;
    EXPECT_NEAR(choose_penalty(scaled) / (delta * s), 1, 1e-13);
    scaled = problem;
    scaled.m /= s;
    EXPECT_NEAR(choose_penalty(scaled) / (delta / s), 1, 1e-13);
  }
  for (const double penalty : {0.0, -1.0, std::nan(""), infinity})
    expect_refused([&] { moderate_delta(problem, penalty); }, "accepted: a positive number");
}

/// A good problem, spoilt in one place.
void refused(const std::function<void(VariationalInequality&)>& spoil, const std::string& words) {
  const TriangleMesh mesh = structured_mesh(3);
  VariationalInequality problem = stiff_problem(Space(mesh, p1()), 0.1);
  ASSERT_NO_THROW(check(problem));
  spoil(problem);
  expect_refused([&] { check(problem); }, words);
}

TEST(Check, RefusesWhatIsNoProblem) {
  using P = VariationalInequality;
  refused([](P& p) { p = {}; }, "no unknowns");
  refused([](P& p) { p.load.conservativeResize(p.load.size() - 1); }, "a1 is");
  refused([](P& p) { p.b.conservativeResize(p.b.rows(), p.b.cols() - 1); }, "B is");
  refused([](P& p) { p.m.conservativeResize(p.m.size() - 1); }, "M has");
  refused([](P& p) { p.fixed.pop_back(); }, "one value per fixed unknown");
  refused([](P& p) { p.contact.pop_back(); }, "one bound per contact unknown");
  refused([=](P& p) { p.a1.valuePtr()[0] = nan; }, "not finite");
  refused([=](P& p) { p.b.valuePtr()[3] = infinity; }, "not finite");
  refused([=](P& p) { p.load(1) = nan; }, "not finite");
  refused([=](P& p) { p.lower(0) = -infinity; }, "not finite");
  refused([=](P& p) { p.fixed_values(0) = nan; }, "not finite");
  refused([=](P& p) { p.m(3) = nan; }, "not finite");
  refused([=](P& p) { p.m(p.m.size() - 1) = infinity; }, "not finite");
  refused([](P& p) { p.m(2) = 0; }, "M is not positive");
  refused([](P& p) { p.m(2) = -1; }, "M is not positive");
  for (const double compliance : {-1e-300, -1.0, nan, infinity})
    refused([=](P& p) { p.compliance = compliance; }, "accepted: a finite number, 0 or more");
  refused([](P& p) { p.a1.coeffRef(0, 1) *= 1 + 1e-9; }, "not symmetric");
  refused([](P& p) { p.a1.coeffRef(1, 0) = 0; }, "not symmetric");
  // an entry whose partner is not stored, on either side of the diagonal, the stored ones before and after it
  for (const auto& [i, j] : {std::pair{0, 15}, {15, 0}, {5, 3}, {3, 5}}) {
    SCOPED_TRACE(testing::Message() << i << ", " << j);
    refused(
        [i = i, j = j](P& p) {
          ASSERT_EQ(p.a1.coeff(i, j), 0);
          p.a1.coeffRef(i, j) = 1;
          p.a1.makeCompressed();
        },
        "not symmetric");
  }
  refused([](P& p) { p.fixed[0] = -1; }, "out of range");
  refused([](P& p) { p.contact[0] = p.size(); }, "out of range");
  refused([](P& p) { p.fixed[1] = p.fixed[0]; }, "fixed or bounded twice");
  refused([](P& p) { p.contact[0] = p.fixed[0]; }, "fixed or bounded twice");
  refused([](P& p) { p.contact[0] = p.contact[1]; }, "fixed or bounded twice");
  refused(
      [](P& p) {
        p.contact.clear();
        p.lower.resize(0);
        p.fixed.clear();
        for (int i = 0; i < p.size(); ++i) p.fixed.push_back(i);
        p.fixed_values = Eigen::VectorXd::Zero(p.size());
      },
      "every unknown is fixed");
  refused([](P& p) { p.a1.uncompress(); }, "compressed");
  refused([](P& p) { p.b.uncompress(); }, "compressed");
}

TEST(Check, TakesAnA1OfZerosWhereBHoldsEverything) {
  // A1 alone may be singular: here it is empty, and B' M B = I
  EXPECT_NO_THROW(
      check(small_problem(Eigen::Matrix2d::Zero(), Eigen::Vector2d::Ones(), {}, Eigen::Matrix2d::Identity())));
}

// ==== Projected forms.

double slope(const std::vector<double>& values) { return std::log2(values.front() / values.back()); }

TEST(Projected, WithSharesOfOneIsTheSameProblem) {
  const SpaceOn space(unstructured_mesh(8), p1());
  for (const double epsilon : {0.9, 0.1, 1e-6, 1e-20, 0.0})
    for (const double kept : {0.0, 0.5, 0.9}) {
      const VariationalInequality problem = stiff_problem(space, epsilon);
      const Eigen::VectorXd u = active_set(problem).u;
      Shares identity(problem.m.size(), problem.m.size());
      identity.setIdentity();
      const Eigen::VectorXd same = active_set(projected(problem, identity, kept)).u;
      EXPECT_LT((same - u).lpNorm<Eigen::Infinity>(), 1e-9 * u.lpNorm<Eigen::Infinity>()) << epsilon << " " << kept;
    }
}

TEST(Projected, IsAsCoerciveAsThePartThatIsKept) {
  // (H1): a1 + kept a0 + (1 - kept) a0_h >= kept (a1 + a0). Nothing kept, a zigzag across the layer costs h^2.
  std::vector<double> nothing, half;
  for (const int n : {4, 8, 16}) {
    const TriangleMesh mesh = structured_mesh(n);
    const Space space(mesh, p1());
    const Shares boxes = box_shares(mesh, layer_strain(space), 2.0 / n, 2.0 / n);
    const VariationalInequality problem = stiff_problem(space, 1);
    const SparseMatrix norm = h1_norm(space);
    nothing.push_back(coercivity(projected(problem, boxes), norm));
    half.push_back(coercivity(projected(problem, boxes, 0.5), norm));
    EXPECT_GE(half.back(), 0.5 * coercivity(problem, norm)) << n;
  }
  EXPECT_NEAR(slope(nothing), 4, 0.6);  // two halvings of h
  EXPECT_LT(slope(half), 0.2);
}

TEST(Projected, SurvivesEveryContactAtEveryEpsilon) {
  const TriangleMesh mesh = unstructured_mesh(16);
  const Space space(mesh, p1());
  const Shares boxes = box_shares(mesh, layer_strain(space), 0.125, 0.125);
  for (const double epsilon : {1.0, 1e-2, 1e-6, 1e-20, 0.0}) {
    VariationalInequality problem = stiff_problem(space, epsilon);
    const Eigen::VectorXd load = problem.load;
    const auto solve = [&](double factor, bool one_sign) {
      problem.load = factor * (one_sign ? Eigen::VectorXd(load.cwiseAbs()) : load);
      return active_set(projected(problem, boxes, 0.5));
    };
    const auto touching = [](const Solution& s) { return std::count(s.active.begin(), s.active.end(), true); };
    const Solution lifted = solve(1, true), pressed = solve(-1, true), part = solve(1, false), none = solve(0, false);
    EXPECT_EQ(touching(lifted), 0) << epsilon;
    EXPECT_EQ(touching(pressed), static_cast<long>(problem.contact.size())) << epsilon;
    EXPECT_GT(touching(part), 0) << epsilon;
    EXPECT_LT(touching(part), static_cast<long>(problem.contact.size())) << epsilon;
    EXPECT_EQ(none.u.norm(), 0) << epsilon;  // gap 0 and force 0 everywhere
    // a load 1e12 times as large: the same shape
    EXPECT_LT((solve(1e12, false).u / 1e12 - part.u).norm(), 1e-9 * part.u.norm()) << epsilon;
  }
}

TEST(Projected, ALockedUThatComesDownSlowlyIsFollowed) {
  // Patches leave nothing in K_0h but 0 on the layer, and their rows of B are nearly dependent. A conforming kernel
  // hides no slope; that of v is a force of size 1, so the norm is round-off.
  for (const int cells : {16, 32}) {
    const TriangleMesh mesh = unstructured_mesh(cells);
    const Space space(mesh, p1());
    const FactoredForm strain = layer_strain(space);
    const auto patches = projected(stiff_problem(space, 1), vertex_shares(mesh, strain, strain_rule(p1())), 0.5);
    const auto slope = load_vector(
        space, [](double x, double y) { return std::sin(std::numbers::pi * x) * std::cos(std::numbers::pi * y); },
        Region::layer);
    EXPECT_LT(dual_norm(patches, h1_norm(space), slope, true), 1e-6) << cells;
  }
}

TEST(Projected, RefusesWhatCannotBeKept) {
  EXPECT_EQ(projected_compliance(0.25, 0), 0.25);
  EXPECT_EQ(projected_compliance(1, 0.5), 1);
  EXPECT_EQ(projected_compliance(0, 0.5), 0);
  expect_refused([] { projected_compliance(0.5, 1); }, "kept = 1; accepted");
  expect_refused([] { projected_compliance(0.5, -0.1); }, "kept = -0.1; accepted");
  expect_refused([] { projected_compliance(2, 0.5); }, "compliance 2 with kept = 0.5");
  expect_refused([] { projected_compliance(NAN, 0.5); }, "compliance nan");
}

// ==== Problems whose contact set is held.

TEST(HeldInContact, RefusesWhatDoesNotFit) {
  const SpaceOn space(block(4), p2());
  VariationalInequality problem = rubber(space, true);
  expect_refused([&] { held_in_contact(problem, {true}); }, "1 marks; accepted: 9");
  problem.upper = Eigen::VectorXd::Constant(problem.lower.size(), 1);
  expect_refused([&] { held_in_contact(problem, std::vector<bool>(9)); }, "held_in_contact: upper bounds");
}

}  // namespace antilock::test::problem_test
