// Displacements that meet with different values at a corner or jump, and a body that hangs from a
// far softer one, through run_scene. Sources: IFEM #755, Albany #427, mfem #1607 (two values at a
// corner); MYSTRAN #146, K2Engineering #7 (two stiffnesses).
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "antilock/mesh/write_msh.hpp"
#include "scenes/runner.hpp"
#include "support/bodies.hpp"
#include "support/scenes.hpp"

namespace antilock::test::meeting_values_test {

/// The unit square with the groups left, right and top; its lower side is contact.
std::string square(const TemporaryFolder& folder, int cells) {
  const TriangleMesh mesh = retagged(structured_mesh(cells, {0}), [](double x, double) {
    return natural_group(x == 0 ? 0 : x == 1 ? 1 : 2);
  });
  const std::string path = (folder / "square.msh").string();
  write_msh(path, mesh, {{"left"}, {"right"}, {"top"}});
  return path;
}
std::string edge(const std::string& group, const std::string& what) {
  return "[[edge]]\ngroup = \"" + group + "\"\n" + what + "\n";
}
std::string given(const std::string& group, const std::string& value) {
  return edge(group, "displacement = \"" + value + "\"");
}

nlohmann::json answered(const std::string& sections, const std::string& element, int cells = 4,
                        const std::string& f = "0") {
  const TemporaryFolder folder;
  return SceneRun(fmt::format("[load]\nf = \"{}\"\n{}[mesh]\nkind = \"file\"\nfile = "
                              "\"{}\"\n[method]\nelement = \"{}\"\n",
                              f, sections, square(folder, cells), element))
      .summary();
}

TEST(MeetingValues, AreWarnedOfAndDoNotDependOnTheOrder) {
  const std::string left = given("left", "0"), right = given("right", "0.05"),
                    top = given("top", "0");
  for (const std::string element : {"P1", "CR", "P2"}) {
    const auto one = answered(left + right + top, element),
               other = answered(top + right + left, element);
    EXPECT_EQ(one["energy"], other["energy"]) << element;
    for (const auto& summary : {one, other}) {
      const std::string warning = summary["warning"];
      EXPECT_NE(warning.find("at (1, 1)"), std::string::npos) << warning;
      EXPECT_NE(warning.find("right gives u = 0.05"), std::string::npos) << warning;
      EXPECT_NE(warning.find("top gives u = 0"), std::string::npos) << warning;
    }
  }
}

// The mean of the two values stands at the corner, and nothing is said where values agree, to
// round-off or by a root.
TEST(MeetingValues, HaveTheirMeanAtTheCorner) {
  const std::string at = "[at]\npoints = [[1, 1], [0, 1]]\n";
  const auto meet =
      answered(given("left", "0") + given("right", "0.05") + given("top", "0") + at, "P1");
  EXPECT_NEAR(meet["at"][0]["u"].get<double>(), 0.025, 1e-15);
  EXPECT_NEAR(meet["at"][1]["u"].get<double>(), 0, 1e-15);
  for (const std::string top :
       {"sin(pi*x)", "sqrt(x)*(1 - x)", "0.1*x*(1 - x)", "x*(1-x)*tanh(1000*(x-0.3))"})
    EXPECT_EQ(
        answered(given("left", "0") + given("right", "0") + given("top", top), "P1")["warning"], "")
        << top;
}

// A clamped edge gives way to the displacement that it meets: the corner has the displacement's
// value, and a warning says so. Where the displacement is 0 there, both agree.
TEST(MeetingValues, OfAClampedEdgeGiveWayToADisplacement) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = retagged(structured_mesh(4, {0}), [](double x, double) {
    return x == 0 ? EdgeTag::clamped : natural_group(x == 1 ? 0 : 1);
  });
  const std::string path = (folder / "square.msh").string();
  write_msh(path, mesh, {{"right"}, {"top"}});
  for (const auto& [top, corner] : {std::pair<std::string, double>{"0.05", 0.05}, {"0.05*x", 0}})
    for (const std::string element : {"P1", "P2"}) {
      const SceneRun run(edge("right", "free = true") + given("top", top) +
                         "[at]\npoints = [[0, 1]]\n[load]\nf = \"0\"\n" +
                         "[mesh]\nkind = \"file\"\nfile = \"" + path +
                         "\"\n[method]\nelement = \"" + element + "\"\n");
      const auto summary = run.summary();
      EXPECT_NEAR(summary["at"][0]["u"].get<double>(), corner, 1e-15) << element;
      const std::string warning = summary["warning"];
      EXPECT_EQ(warning.find("the group clamped gives u = 0") != std::string::npos, corner != 0)
          << warning;
      EXPECT_EQ(warning.find("the group top gives u = 0.05") != std::string::npos, corner != 0)
          << warning;
    }
}

// A formula that jumps at a vertex or inside of an edge of the mesh.
TEST(MeetingValues, OfOneFormulaAreWarnedOf) {
  for (const std::string jump : {"x < 0.5 ? 0 : 1", "x > 0.3 ? 1 : 0", "rint(1.5*x)"}) {
    const std::string warning =
        answered(edge("left", "free = true") + edge("right", "free = true") + given("top", jump),
                 "CR")["warning"];
    EXPECT_NE(warning.find("top jumps"), std::string::npos) << jump << ": " << warning;
  }
}

// With an accuracy they are refused: no bound of the energy is proved where there is none.
TEST(MeetingValues, AreRefusedWithAnAccuracy) {
  const TemporaryFolder folder;
  const SceneRun run("[load]\nf = \"0\"\n" + given("left", "0") + given("right", "0.05") +
                     given("top", "0") + "[mesh]\nkind = \"file\"\nfile = \"" + square(folder, 4) +
                     "\"\n[method]\naccuracy = 0.05\n");
  expect_no_answer(run, "accepted: values that do not jump");
}

// u' = y in the upper half, under f = -1 and held at the top: u(1/2) = (1/4 - 1) / 2 however stiff
// the lower half is.
TEST(MeetingValues, AStiffHalfHangsFromASoftOne) {
  const std::string sides =
      edge("left", "free = true") + edge("right", "free = true") + given("top", "0");
  for (const std::string element : {"P1", "CR", "P2"})
    for (const std::string k : {"1e8", "1e12", "1e14", "1e16"}) {
      const auto summary =
          answered("[body]\nstiffness = \"y < 0.5 ? " + k + " : 1\"\n[contact]\ngap = \"10\"\n" +
                       sides + "[at]\npoints = [[0.5, 0.5]]\n",
                   element, 4, "-1");
      EXPECT_NEAR(summary["at"][0]["u"].get<double>(), -0.375, 1e-7) << element << k;
      EXPECT_EQ(summary["warning"], "") << element << k;
    }
}

}  // namespace antilock::test::meeting_values_test
