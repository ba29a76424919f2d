// The bounds of a problem: limits that do not exist are infinite.
#include "antilock/problem/bounds.hpp"

#include "support/scenes.hpp"

namespace antilock::test::problem_test::bounds_test {

TEST(BoundLimits, AreInfiniteWhereNoneIsGiven) {
  const Eigen::VectorXd low{{-1, 0}}, high{{2, 0}}, none = Eigen::VectorXd::Constant(2, infinity);
  const BoundLimits below(low), both(low, high), soft(low, high, Eigen::VectorXd{{infinity, 3}});
  EXPECT_EQ(below.count(), 2);
  EXPECT_EQ(below.upper, none);
  EXPECT_EQ(below.force_limit, none);
  EXPECT_EQ(both.force_limit, none);
  EXPECT_FALSE(below.has_upper_bounds());
  EXPECT_TRUE(both.has_upper_bounds());
  EXPECT_FALSE(both.has_force_limits());
  EXPECT_TRUE(soft.has_force_limits());
  EXPECT_FALSE(both.is_equation(0));
  EXPECT_TRUE(both.is_equation(1));
  EXPECT_EQ(BoundLimits().count(), 0);
  EXPECT_FALSE(BoundLimits().has_upper_bounds() || BoundLimits().has_force_limits());
}

TEST(BoundLimits, ANumberThatIsNoneCountsAsALimit) {
  const BoundLimits spoilt(Eigen::VectorXd{{0}}, Eigen::VectorXd{{nan}}, Eigen::VectorXd{{nan}});
  EXPECT_TRUE(spoilt.has_upper_bounds());
  EXPECT_TRUE(spoilt.has_force_limits());
}

// u_2 >= -1, u_0 - u_1 <= 3 with a force of at most 5
TEST(Bounds, ListUnknownsThenConstraints) {
  const RowMatrix row = Eigen::MatrixXd(Eigen::RowVector3d(1, -1, 0)).sparseView();
  const Bounds bounds(
      {2},
      {Eigen::Vector2d(-1, -infinity), Eigen::Vector2d(infinity, 3), Eigen::Vector2d(infinity, 5)},
      row);
  const Eigen::Vector3d u(6, 2, -0.5);
  EXPECT_EQ(bounded_values(bounds, u), Eigen::Vector2d(-0.5, 4));
  EXPECT_EQ(bound_forces(bounds, Eigen::Vector2d(7, -5), 3), Eigen::Vector3d(-5, 5, 7));
  EXPECT_EQ(distance_to_bound(bounds, u), Eigen::Vector2d(0.5, infinity));
  EXPECT_EQ(friction_energy(bounds, u), 5);  // u_0 - u_1 is beyond 3 by 1
  expect_refused([&] { require_bounds_on_unknowns(bounds, "it"); },
                 "it: bounds on constraints are not known here");
  expect_refused([&] { require_hard_bounds(bounds, "it"); }, "it: friction is not known here");
  const Bounds below = Bounds::lower_on({2}, Eigen::VectorXd{{-1}});
  EXPECT_EQ(distance_to_bound(below, u), Eigen::VectorXd{{0.5}});
  EXPECT_EQ(friction_energy(below, u), 0);
  EXPECT_NO_THROW(require_lower_bounds(below, "it"));
}

}  // namespace antilock::test::problem_test::bounds_test
