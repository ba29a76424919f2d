// An accuracy asked for in a scene file: the proof in the summary, and what is refused.
#include <nlohmann/json.hpp>
#include <numbers>

#include "antilock/exact/exact_table.hpp"
#include "antilock/measure/errors.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/read_msh.hpp"
#include "antilock/mesh/write_msh.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "scenes/runner.hpp"
#include "support/bodies.hpp"
#include "support/scenes.hpp"

namespace antilock::test::accuracy_test {

std::string scene(const std::string& method, const std::string& layer = "epsilon = 1e-6",
                  int cells = 8) {
  return fmt::format(
      "[load]\nf = \"10*sin(2*pi*x)\"\n[layer]\n{}\n[contact]\n[mesh]\nkind = "
      "\"unstructured\"\ncells = {}\n"
      "[method]\n{}\n",
      layer, cells, method);
}

TEST(Accuracy, OfASceneIsProvedInItsSummary) {
  for (const double epsilon : {1.0, 1e-6, 0.0})
    for (const std::string of : {"displacement", "stress"}) {
      const SceneRun run(scene(fmt::format("accuracy = 0.1\nof = \"{}\"", of),
                               fmt::format("epsilon = {}", epsilon)));
      const auto summary = run.summary();
      const auto& proof = summary["certificate"];
      EXPECT_EQ(proof["asked"], 0.1);
      EXPECT_EQ(proof["of"], of);
      EXPECT_LE(proof["relative"], 0.1);
      EXPECT_GE(proof["relative"], 0.05);
      const double exact = ExactSolution(paper_sine_load(), epsilon, true, 14).energy();
      EXPECT_LE(proof["energy_lower"], exact);
      EXPECT_GE(proof["energy_upper"], exact);
      // the gap is 0: L(u) = -2 J(u)
      EXPECT_LE(summary["compliance"]["lower"], -2 * exact);
      EXPECT_GE(summary["compliance"]["upper"], -2 * exact);
      ASSERT_FALSE(proof["levels"].empty());
      const auto& last = proof["levels"].back();
      EXPECT_EQ(last["unknowns"], summary["dofs"]);
      EXPECT_EQ(last["bound"], proof["bound"]);
      EXPECT_GT(last["seconds"], 0);
      EXPECT_EQ(summary["element"], "CR");
      EXPECT_EQ(summary["scene"]["method"]["accuracy"], 0.1);
      // the answer's files are those of the last mesh
      const TriangleMesh mesh = read_msh((run.results / "mesh.msh").string());
      EXPECT_EQ(read_csv(run.results / "solution.csv").rows.rows(), mesh.edge_count());
      EXPECT_NEAR(summary["h"], mesh.diameter(), 1e-12);
    }
}

// With a gap K is no cone, and L(u) is not -2 J(u).
TEST(Accuracy, ProvesNoComplianceBesideAGap) {
  const SceneRun run(
      "[load]\nf = \"-10\"\n[contact]\ngap = \"0.1\"\n[mesh]\nkind = \"structured\"\n"
      "cells = 8\n[method]\naccuracy = 0.1\n");
  const auto summary = run.summary();
  EXPECT_GT(summary["contact"]["active"].get<int>(), 0);
  EXPECT_TRUE(summary["compliance"]["lower"].is_null());
  EXPECT_TRUE(summary["compliance"]["upper"].is_null());
}

TEST(Accuracy, GoesWithABodyFromAFile) {
  const TemporaryFolder folder;
  const std::string path = (folder / "l.msh").string();
  write_msh(path, extruded(l_shape(8), 1));
  const SceneRun run(
      "[load]\nf = \"-5\"\n[layer]\nepsilon = 1e-3\n[contact]\n[mesh]\nkind = \"file\"\nfile = \"" +
      path + "\"\n[method]\naccuracy = 0.1\n");
  EXPECT_LE(run.summary()["certificate"]["relative"], 0.1);
}

TEST(Accuracy, IsProvedOfP1AndP2Answers) {
  for (const std::string element : {"P1", "P2"})
    for (const double epsilon : {1.0, 0.3}) {
      const SceneRun run(scene("accuracy = 0.2\nelement = \"" + element + "\"",
                               fmt::format("epsilon = {}", epsilon)));
      const auto summary = run.summary();
      EXPECT_EQ(summary["element"], element);
      EXPECT_LE(summary["certificate"]["relative"], 0.2);
      const ExactSolution exact_solution(paper_sine_load(), epsilon, true, 14);
      const Space space(read_msh((run.results / "mesh.msh").string()), antilock::element(element));
      const VariationalInequality problem = stiff_problem(space, epsilon);
      const Solution same = active_set(problem);  // the gap is 0: the same problem
      EXPECT_NEAR(summary["energy"], energy(problem, same), 1e-9);
      EXPECT_GE(summary["certificate"]["bound"],
                measure_errors(space, same, epsilon, reference(ExactTable(exact_solution))).energy);
    }
}

TEST(Accuracy, OfALockedAnswerEndsWithWhatLocks) {
  for (const std::string element : {"P1", "P2"}) {
    // at 1e-6 P2 on the first mesh would need 1.7e6 unknowns, which are within the limit of 2e6
    const SceneRun run(scene("accuracy = 0.1\nelement = \"" + element + "\"", "epsilon = 1e-7"));
    expect_no_answer(run, element + " locks in this layer", 3);
    EXPECT_NE(run.outcome.err.find("in 1 level"), std::string::npos) << run.outcome.err;
    EXPECT_EQ(run.outcome.err.find("can be reached"), std::string::npos) << run.outcome.err;
  }
}

TEST(Accuracy, OfACurveIsProvedOfItsPolygonAndSaysSo) {
  const TemporaryFolder folder;
  const std::string path = (folder / "arch.msh").string();
  for (const double rise : {0.2, 0.0}) {
    TriangleMesh mesh = unstructured_mesh(8, {0});
    for (int v = 0; v < mesh.vertex_count(); ++v)
      mesh.vertices(v, 1) *= 1 + rise * std::sin(std::numbers::pi * mesh.vertices(v, 0));
    write_msh(path, mesh);
    const SceneRun run("[load]\nf = \"-5\"\n[contact]\n[mesh]\nkind = \"file\"\nfile = \"" + path +
                       "\"\n[method]\naccuracy = 0.2\n");
    const std::string warning = run.summary()["warning"];
    EXPECT_EQ(warning.find("proved of this polygon") != std::string::npos, rise > 0) << warning;
  }
}

// A body whose top is an arc of a circle through (0, 1), (1/2, 1 + rise) and (1, 1), first as a
// polygon of a few edges. With the arc's .geo the brackets of two first meshes meet; without it
// they belong to two polygons.
TEST(Accuracy, OfACurveReturnsToTheGeometryThatTheSceneNames) {
  const TemporaryFolder folder;
  const double rise = -0.1, radius = (0.25 + rise * rise) / (2 * -rise), centre = 1 + rise + radius;
  const auto arc = [&](double x) {
    return centre - std::sqrt(radius * radius - (x - 0.5) * (x - 0.5));
  };
  const std::string geometry = fmt::format(
      "Point(1) = {{0, 0, 0}}; Point(2) = {{1, 0, 0}}; Point(3) = {{1, 1, 0}}; Point(4) = {{0, 1, "
      "0}};\n"
      "Point(5) = {{0.5, {:.17g}, 0}};\nLine(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(4) = {{4, "
      "1}};\n",
      centre);
  const auto run = [&](int cells, const std::string& curve, double row = 1,
                       const std::string& more = "accuracy = 0.05") {
    TriangleMesh mesh = structured_mesh(cells, {0});
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      double& y = mesh.vertices(v, 1);
      if (y > 0 && y < 1) y = 1 - (1 - y) * row;  // row < 1: flat triangles below the arc
      y *= arc(mesh.vertices(v, 0));
    }
    write_msh(folder / "arch.msh", mesh);
    std::filesystem::remove(folder / "arch.geo");
    if (!curve.empty()) std::ofstream(folder / "arch.geo") << geometry << curve;
    const std::string named =
        curve.empty() ? "" : "geometry = \"" + (folder / "arch.geo").string() + "\"\n";
    return SceneRun("[load]\nf = \"10\"\n[mesh]\nkind = \"file\"\nfile = \"" +
                    (folder / "arch.msh").string() + "\"\n" + named +
                    (more == "refinements" ? "refinements = 3\n" : "[method]\n" + more + "\n"));
  };
  const auto bracket = [&](int cells, const std::string& curve) {
    const SceneRun found = run(cells, curve);
    EXPECT_EQ(found.outcome.status, 0) << found.outcome.err;
    const auto summary = found.summary();
    const std::string of = summary["certificate"]["proved_of"], warning = summary["warning"];
    EXPECT_EQ(of.find("on the curves of arch.geo") != std::string::npos, !curve.empty()) << of;
    EXPECT_EQ(warning, "") << "four edges look like no curve";
    EXPECT_EQ(summary["scene"]["method"]["tolerance"], 1e-2 * 0.05);
    return std::pair<double, double>(summary["certificate"]["energy_lower"],
                                     summary["certificate"]["energy_upper"]);
  };
  const std::string circle = "Circle(3) = {3, 5, 4};\n";
  const auto coarse = bracket(2, circle), fine = bracket(4, circle), polygon = bracket(2, ""),
             other = bracket(4, "");
  EXPECT_LT(std::max(coarse.first, fine.first), std::min(coarse.second, fine.second));
  EXPECT_LT(polygon.second, other.first)
      << "the polygon of two edges lies above that of four: a larger body, less energy";
  EXPECT_LT(other.second, fine.first);

  const SceneRun refinements = run(2, circle, 1, "refinements");
  const TriangleMesh mesh = read_msh((refinements.output / "results/mesh.msh").string());
  int on_top = 0;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (const double x = mesh.vertices(v, 0); mesh.vertices(v, 1) > arc(x) - 1e-3) {
      EXPECT_NEAR(mesh.vertices(v, 1), arc(x), 1e-8)
          << x;  // gmsh looks for the nearest point to 1e-9 of its parameter
      ++on_top;
    }
  EXPECT_EQ(on_top, 17);

  expect_no_answer(run(2, "Line(3) = {3, 4};\n"),
                   "arch.geo: no curve of it holds the edge of the boundary from");
  expect_no_answer(run(2, "Line(3) = {3 4};\n"), "arch.geo', line 4: syntax error");
  expect_no_answer(run(2, circle, 0.02), "for which the first mesh is too coarse: inverted");
}

TEST(Accuracy, OutOfReachIsStatusThreeAndNoFiles) {
  expect_no_answer(SceneRun(scene("accuracy = 0.001\nmost_unknowns = 20000")), "can be reached", 3);
  expect_no_answer(SceneRun(scene("accuracy = 0.1\nmost_unknowns = 50")),
                   "cannot hold the first mesh");
}

}  // namespace antilock::test::accuracy_test
