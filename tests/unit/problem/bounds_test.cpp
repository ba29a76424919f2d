// Problems whose contact set is held.
#include "antilock/problem/bounds.hpp"
#include "support/platen.hpp"
#include "support/scenes.hpp"

namespace antilock::test::problem_test::bounds_test {

TEST(HeldInContact, RefusesWhatDoesNotFit) {
  const Space space(block(4), p2());
  VariationalInequality problem = rubber(space, true);
  expect_refused([&] { equality_constrained(problem, {true}); }, "1 marks; accepted: 9");
  problem.upper = Eigen::VectorXd::Constant(problem.lower.size(), 1);
  expect_refused([&] { equality_constrained(problem, std::vector<bool>(9)); }, "equality_constrained: upper bounds");
}

}  // namespace antilock::test::problem_test::bounds_test
