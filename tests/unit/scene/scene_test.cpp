// A scene says which effects there are, and refuses what makes no sense with one line.
#include "antilock/scene/scene.hpp"
#include "support/scenes.hpp"

namespace antilock::test::scene_test::scene_test {

TEST(Scene, NamesTheEffectsPresent) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(Scene({paper_load}).effects(), Names{});
  EXPECT_EQ(Scene({paper_load}, StiffLayer{0.1}).effects(), Names{"layer"});
  EXPECT_EQ(Scene({paper_load}, NoLayer{}, UnilateralContact{}).effects(), Names{"contact"});
  EXPECT_EQ(Scene({paper_load}, VentcelLayer{}, UnilateralContact{}).effects(),
            (Names{"layer", "contact"}));
}

TEST(Scene, KnowsTheDepthOfTheLayersMeshAndThePapersEpsilon) {
  EXPECT_EQ(Scene({paper_load}).layer_depth(), 0);
  EXPECT_EQ(Scene({paper_load}, VentcelLayer{}).layer_depth(), 0);
  EXPECT_EQ(Scene({paper_load}, StiffLayer{1e-6}).layer_depth(), 1);
  EXPECT_EQ(Scene({paper_load}, ThinLayer{0.25}).layer_depth(), 0.25);
  EXPECT_FALSE(Scene({paper_load}).epsilon());
  EXPECT_EQ(Scene({paper_load}, VentcelLayer{}).epsilon(), 0);
  EXPECT_EQ(Scene({paper_load}, StiffLayer{1e-6}).epsilon(), 1e-6);
  EXPECT_EQ(Scene({paper_load}, ThinLayer{0.25}).epsilon(), 0.25);
}

TEST(Scene, LoadOfTheFiguresPullsLeftAndPressesRight) {
  EXPECT_NEAR(paper_load(0.25, 0.3), 10, 1e-14);
  EXPECT_NEAR(paper_load(0.75, 0.9), -10, 1e-14);
  EXPECT_NEAR(paper_load(1.0 / 12, 0), 5, 1e-14);
}

TEST(Scene, AcceptsEpsilonFromOneDownToExactlyZero) {
  for (const double epsilon : {1.0, 1e-6, 1e-300, 0.0})
    EXPECT_NO_THROW(Scene({paper_load}, StiffLayer{epsilon}));
  for (const double epsilon : {1.0, 1e-3}) EXPECT_NO_THROW(Scene({paper_load}, ThinLayer{epsilon}));
}

TEST(Scene, RefusesEpsilonOutOfRange) {
  for (const double epsilon : {-1e-300, -1.0, 1.0 + 1e-15, nan})
    expect_refused([&] { Scene({paper_load}, StiffLayer{epsilon}); }, "scaled layer: epsilon");
  for (const double epsilon : {0.0, 9.99e-4, -0.5, 1.5, nan})
    expect_refused([&] { Scene({paper_load}, ThinLayer{epsilon}); }, "thin layer: epsilon");
}

TEST(Scene, RefusesABodyWithoutLoadAndContactWithoutGap) {
  expect_refused([] { Scene({Field{}}); }, "no load");
  expect_refused([] { Scene({paper_load}, StiffLayer{0.1, -1}); }, "s > 0");
  const BoundaryCondition pull{"g", BoundaryCondition::Kind::traction};
  expect_refused([&] { Scene({paper_load}, NoLayer{}, {}, {pull}); }, "group g: no value");
  expect_refused([] { Scene({paper_load}, NoLayer{}, UnilateralContact{Profile{}}); }, "no gap");
}

TEST(Scene, RefusesAnObstacleAboveAClampedEnd) {
  expect_refused(
      [] { Scene({paper_load}, NoLayer{}, UnilateralContact{[](double x) { return x - 1e-3; }}); },
      "gap(0)");
  expect_refused(
      [] { Scene({paper_load}, NoLayer{}, UnilateralContact{[](double x) { return 0.5 - x; }}); },
      "gap(1)");
  expect_refused(
      [] { Scene({paper_load}, NoLayer{}, UnilateralContact{[](double) { return nan; }}); },
      "gap(0)");
  const UnilateralContact low{[](double) { return 1; }, {0, 1}, [](double) { return -0.1; }};
  expect_refused([&] { Scene({paper_load}, NoLayer{}, low); }, "ceiling(0)");
  // between the ends the obstacle may press in, and round-off at the ends is no contradiction
  EXPECT_NO_THROW(
      Scene({paper_load}, NoLayer{}, UnilateralContact{[](double x) { return x * (x - 1); }}));
  EXPECT_NO_THROW(Scene({paper_load}, NoLayer{}, UnilateralContact{[](double x) {
                          return -std::sin(std::numbers::pi * x);
                        }}));
}

}  // namespace antilock::test::scene_test::scene_test
