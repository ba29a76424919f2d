// Inputs at the edge of what the library's functions take, each made here after a public report on
// another program, which is named beside it (tests/README.md lists them). Those of scenes, matrices
// and command lines stand in tests/scenes.
#include <filesystem>
#include <limits>

#include "antilock/core/atomic_file.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"

namespace antilock::test::scene_test::unusual_inputs_test {

UnilateralContact between(Profile obstacle, Profile ceiling) {
  UnilateralContact contact{[=](double x) { return -obstacle(x); }};
  contact.upper_obstacle = std::move(ceiling);
  return contact;
}

// jkcshea/ivmte #225: a lower bound above the upper one.
TEST(Ceiling, IsCheckedAgainstTheObstacleUpToTheRoundOffOfTwoFormulas) {
  const auto third = [](double x) { return std::sin(x) / 3; };
  const auto same = [](double x) { return std::sin(x) * (1.0 / 3); };
  const UnilateralContact equal = between(third, same);
  const UnilateralContact below = between(third, [&](double x) { return same(x) - 1e-9; });
  bool differ = false;  // in the last digit, which makes this a test
  for (int i = 0; i <= 1000; ++i) {
    const double x = i / 1000.0;
    differ = differ || same(x) < third(x);
    EXPECT_NO_THROW(check_upper_obstacle(equal, x)) << x;
    EXPECT_THROW(check_upper_obstacle(below, x), Error) << x;
  }
  EXPECT_TRUE(differ);
  EXPECT_NO_THROW(check_upper_obstacle(UnilateralContact{}, 0.5));  // without a ceiling
}

TEST(Ceiling, EqualToTheObstacleIsAProblemWithASolution) {
  const TriangleMesh mesh = structured_mesh(16, {0});
  const auto hill = [](double x) { return std::sin(std::numbers::pi * x) / 3; };
  const auto same = [](double x) { return std::sin(std::numbers::pi * x) * (1.0 / 3); };
  for (const Element* element : {&p1(), &crouzeix_raviart()}) {
    const Space space(mesh, *element);
    const VariationalInequality problem =
        assemble(Scene({paper_load}, NoLayer{}, between(hill, same)), space);
    EXPECT_GE((problem.bounds.upper - problem.bounds.lower).minCoeff(), 0);
    const Solution solution = active_set(problem);
    // held on both sides: u is the obstacle to the last digit of either formula
    for (const int i : problem.bounds.unknowns)
      EXPECT_NEAR(solution.u(i), hill(space.dof_coordinates()(i, 0)), 1e-15);
  }
}

// JuliaPackaging/BinaryBuilder.jl #740: a link in the place of a folder.
TEST(ResultsFolder, ThatIsALinkToNothingIsRefusedBeforeAnythingIsWritten) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("nowhere", folder / "link");
  const std::filesystem::path link(folder / "link");
  EXPECT_THROW(check_folder(link), Error);
  EXPECT_THROW(check_folder(link / "below"), Error);
  std::filesystem::create_directory(folder / "nowhere");
  EXPECT_NO_THROW(check_folder(link));  // a link to a folder is one
  EXPECT_NO_THROW(check_folder(link / "below"));
}

}  // namespace antilock::test::scene_test::unusual_inputs_test
