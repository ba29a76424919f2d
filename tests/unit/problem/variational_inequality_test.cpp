// Malformed problems are refused before any solver sees them.
#include "antilock/problem/choose_penalty.hpp"
#include "support/platen.hpp"
#include "support/scenes.hpp"
#include "support/small_problem.hpp"

namespace antilock::test::problem_test::variational_inequality_test {

TEST(ChoosePenalty, IsInTheUnitsOfCompliance) {
  // A1 times s: the same problem at compliance / s. B times s, or M times s^2: at compliance s^2.
  const TriangleMesh mesh = structured_mesh(8);
  const VariationalInequality problem = stiff_problem(Space(mesh, p1()), 0);
  const double delta = choose_penalty(problem);
  EXPECT_EQ(penalty_parameter(problem), delta);
  EXPECT_EQ(penalty_parameter(problem, 1e-3), 1e-3);
  for (const double s : {1e3, 1e6}) {
    VariationalInequality scaled = problem;
    scaled.b *= s;
    EXPECT_NEAR(choose_penalty(scaled) / (delta * s * s), 1,
                1e-13);  // round-off of two ratios and their roots
    scaled = problem;
    scaled.a1 /= s;
    EXPECT_NEAR(choose_penalty(scaled) / (delta * s), 1, 1e-13);
    scaled = problem;
    scaled.m /= s;
    EXPECT_NEAR(choose_penalty(scaled) / (delta / s), 1, 1e-13);
  }
  for (const double penalty : {0.0, -1.0, std::nan(""), infinity})
    expect_refused([&] { penalty_parameter(problem, penalty); }, "accepted: a positive number");
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
  refused([](P& p) { p.dirichlet_dofs.pop_back(); }, "one value per fixed unknown");
  refused([](P& p) { p.bounds.unknowns.pop_back(); }, "one bound per contact unknown");
  refused([](P& p) { p.bounds.upper.resize(0); }, "upper has 0 entries; accepted 2, as in lower");
  refused([](P& p) { p.bounds.force_limit.resize(0); },
          "force_limit has 0 entries; accepted 2, as in lower");
  refused([=](P& p) { p.a1.valuePtr()[0] = nan; }, "not finite");
  refused([=](P& p) { p.b.valuePtr()[3] = infinity; }, "not finite");
  refused([=](P& p) { p.load(1) = nan; }, "not finite");
  refused([=](P& p) { p.bounds.lower(0) = -infinity; }, "not finite");
  refused([=](P& p) { p.dirichlet_values(0) = nan; }, "not finite");
  refused([=](P& p) { p.m(3) = nan; }, "not finite");
  refused([=](P& p) { p.m(p.m.size() - 1) = infinity; }, "not finite");
  refused([](P& p) { p.m(2) = 0; }, "M is not positive");
  refused([](P& p) { p.m(2) = -1; }, "M is not positive");
  for (const double compliance : {-1e-300, -1.0, nan, infinity})
    refused([=](P& p) { p.compliance = compliance; }, "accepted: a finite number, 0 or more");
  refused([](P& p) { p.a1.coeffRef(0, 1) *= 1 + 1e-9; }, "not symmetric");
  refused([](P& p) { p.a1.coeffRef(1, 0) = 0; }, "not symmetric");
  // an entry whose partner is not stored, on either side of the diagonal, the stored ones before
  // and after it
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
  refused([](P& p) { p.dirichlet_dofs[0] = -1; }, "out of range");
  refused([](P& p) { p.bounds.unknowns[0] = p.size(); }, "out of range");
  refused([](P& p) { p.dirichlet_dofs[1] = p.dirichlet_dofs[0]; }, "fixed or bounded twice");
  refused([](P& p) { p.bounds.unknowns[0] = p.dirichlet_dofs[0]; }, "fixed or bounded twice");
  refused([](P& p) { p.bounds.unknowns[0] = p.bounds.unknowns[1]; }, "fixed or bounded twice");
  refused(
      [](P& p) {
        p.bounds = {};
        p.dirichlet_dofs.clear();
        for (int i = 0; i < p.size(); ++i) p.dirichlet_dofs.push_back(i);
        p.dirichlet_values = Eigen::VectorXd::Zero(p.size());
      },
      "every unknown is fixed");
  refused([](P& p) { p.a1.uncompress(); }, "compressed");
  refused([](P& p) { p.b.uncompress(); }, "compressed");
}

TEST(EqualityConstrained, RefusesWhatDoesNotFit) {
  const Space space(block(4), p2());
  VariationalInequality problem = rubber(space, true);
  expect_refused([&] { equality_constrained(problem, {true}); }, "1 marks; accepted: 9");
  problem.bounds.upper = Eigen::VectorXd::Constant(problem.bounds.count(), 1);
  expect_refused([&] { equality_constrained(problem, std::vector<bool>(9)); },
                 "equality_constrained: upper bounds");
}

TEST(Check, TakesAnA1OfZerosWhereBHoldsEverything) {
  // A1 alone may be singular: here it is empty, and B' M B = I
  EXPECT_NO_THROW(check(small_problem(Eigen::Matrix2d::Zero(), Eigen::Vector2d::Ones(), {},
                                      Eigen::Matrix2d::Identity())));
}

}  // namespace antilock::test::problem_test::variational_inequality_test
