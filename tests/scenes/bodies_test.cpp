// Bodies other than the unit square, from mesh files: each answer is known from one of the unit
// square, or from the library called directly.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "antilock/form/gradient_forms.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/write_msh.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/runner/solve_scene.hpp"
#include "scenes/runner.hpp"
#include "support/bodies.hpp"
#include "support/scenes.hpp"

namespace antilock::test::bodies_test {

std::string scene_on(const std::string& mesh, const std::string& sections,
                     const std::string& element, const std::string& f = "0") {
  return fmt::format(
      "[load]\nf = \"{}\"\n{}[mesh]\nkind = \"file\"\nfile = \"{}\"\n[method]\nelement = \"{}\"\n",
      f, sections, mesh, element);
}

/// A scene on the mesh, written beside it.
struct OnMesh {
  OnMesh(const TriangleMesh& mesh, const std::string& effects, const std::string& f,
         const std::string& element = "CR")
      : path((folder / "body.msh").string()) {
    write_msh(path, mesh);
    run.emplace(scene_on(path, effects, element, f));
  }
  double energy() const { return run->summary()["energy"]; }

  TemporaryFolder folder;
  std::string path;
  std::optional<SceneRun> run;
};

TriangleMesh moved(TriangleMesh mesh, double factor, double along) {
  mesh.vertices *= factor;
  mesh.vertices.col(0).array() += along;
  return mesh;
}

TEST(Bodies, OfAnotherSizeScaleTheirAnswer) {
  // v(x) = s^2 u(x / s) solves the problem of the s times larger body: its energy is s^4 that of u
  const OnMesh one(structured_mesh(8, {0}), "[contact]\n", "10*sin(2*pi*x)");
  const OnMesh three(moved(structured_mesh(8, {0}), 3, 0), "[contact]\n", "10*sin(2*pi*x/3)");
  ASSERT_EQ(three.run->outcome.status, 0) << three.run->outcome.err;
  EXPECT_NEAR(three.energy(), 81 * one.energy(), 1e-8 * 81 * std::abs(one.energy()));
  EXPECT_EQ(three.run->summary()["warning"], "");
}

TEST(Bodies, ElsewhereHaveTheSameAnswer) {
  const std::string effects[] = {"[layer]\nepsilon = 1e-3\n[contact]\ngap = \"0.001\"\n",
                                 "[layer]\nepsilon = 0\nmodel = \"ventcel\"\n[contact]\n"};
  for (const bool ventcel : {false, true}) {
    const TriangleMesh mesh = structured_mesh(8, {ventcel ? 0.0 : 1.0});
    const OnMesh here(mesh, effects[ventcel], "10*sin(2*pi*x)");
    std::string effects_there = effects[ventcel];  // a gap at x = 0 and 1 is none of this body's
    if (!ventcel) effects_there.replace(effects_there.find("0.001"), 5, "x < 0 ? 0.001 : -1");
    const OnMesh there(moved(mesh, 1, -7), effects_there, "10*sin(2*pi*(x + 7))");
    ASSERT_EQ(there.run->outcome.status, 0) << there.run->outcome.err;
    EXPECT_NEAR(there.energy(), here.energy(), 1e-8 * std::abs(here.energy())) << ventcel;
  }
}

TEST(Bodies, OfAnyShapeAreWhatTheLibrarySolves) {
  const Scene scene(Body{paper_load}, StiffLayer{1e-3}, UnilateralContact{});
  const std::string effects = "[layer]\nepsilon = 1e-3\n[contact]\n";
  for (const TriangleMesh& body : {l_shape(8), bridge(8)}) {
    const TriangleMesh mesh = extruded(body, 1e-3);
    const OnMesh file(mesh, effects, "10*sin(2*pi*x)");
    ASSERT_EQ(file.run->outcome.status, 0) << file.run->outcome.err;
    const Space space(mesh, crouzeix_raviart());
    const Solution direct = active_set(assemble(scene, space));
    EXPECT_NEAR(file.run->summary()["u_max"].get<double>(), direct.u.maxCoeff(), 1e-9);
    EXPECT_NEAR(file.run->summary()["u_min"].get<double>(), direct.u.minCoeff(), 1e-9);
  }
}

/// The unit square with its sides in the groups left, right and top; contact below. `halves`: the
/// body in two surfaces.
std::string named_square(const TemporaryFolder& folder, int cells, bool halves = false) {
  TriangleMesh mesh = structured_mesh(cells, {0});
  const std::vector<BoundaryCondition> edges{{"left"}, {"right"}, {"top"}};
  for (int e = 0; e < mesh.edge_count(); ++e) {
    if (mesh.edge_tag[e] != EdgeTag::clamped) continue;
    const Eigen::RowVector2d middle =
        (mesh.vertices.row(mesh.edges(e, 0)) + mesh.vertices.row(mesh.edges(e, 1))) / 2;
    mesh.edge_tag[e] = natural_group(middle(0) == 0 ? 0 : middle(0) == 1 ? 1 : 2);
  }
  const std::string path = (folder / "square.msh").string();
  write_msh(path, mesh, edges);
  if (!halves) return path;
  std::string text = contents(path), out;
  text.replace(text.find("2 1 \"body\""), 10, "2 1 \"body\"\n2 2 \"stiff\"");
  text.replace(text.find("\n5\n"), 3, "\n6\n");
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line); out += line + "\n") {
    int number = 0, type = 0, tags = 0, a = 0, b = 0, v[3];
    std::istringstream fields(line);
    if (!(fields >> number >> type >> tags >> a >> b >> v[0] >> v[1] >> v[2]) || type != 2 ||
        tags != 2)
      continue;
    double x = 0;
    for (const int i : v) x += mesh.vertices(i - 1, 0) / 3;
    if (x > 0.5) line = fmt::format("{} 2 2 2 2 {} {} {}", number, v[0], v[1], v[2]);
  }
  std::ofstream(path) << out;
  return path;
}
std::string edge(const std::string& group, const std::string& what) {
  return "[[edge]]\ngroup = \"" + group + "\"\n" + what + "\n";
}

// u = 3 - 2 x, by what holds at the left, a spring at the right (-u_x = -2 = -k u, u(1) = 1) or the
// same force, nothing above and below: in every space exactly.
TEST(Bodies, HoldPullAndSpringOnTheEdgesOfAGroup) {
  for (const std::string element : {"P1", "CR", "P2", "P3", "P4", "M2"})
    for (const std::string right :
         {"spring = \"2\"", "traction = \"-2 + 0*x\"", "displacement = \"1\""}) {
      const TemporaryFolder folder;
      const SceneRun run(
          scene_on(named_square(folder, 4),
                   edge("left", "displacement = \"3 + y - y\"") + edge("right", right) +
                       edge("top", element == "P1" ? "spring = \"0*x\"" : "free = true") +
                       "[at]\npoints = [[0.25, 0.6], [1, 1]]\n",
                   element));
      const auto s = run.summary();
      const Csv u = read_csv(run.results / "solution.csv");
      EXPECT_LE((u.rows.col(2).array() - 3 + 2 * u.rows.col(0).array()).abs().maxCoeff(), 1e-12)
          << element << right;
      EXPECT_NEAR(s["at"][0]["u"].get<double>(), 2.5, 1e-12);
      EXPECT_NEAR(s["at"][1]["u"].get<double>(), 1, 1e-12);
    }
}

// u = (0.1 + 0.1 x)(1 - y) is harmonic, and its traction on the sides is -0.1 (1 - y) and 0.1 (1 -
// y). The obstacle holds it up with the pressure -u_y = 0.1 + 0.1 x: force 0.15, moment 1/20 +
// 1/30. It is in the space from P2 on, where lambda_i = int p phi_i.
TEST(Bodies, KnowForceAndMomentOfTheObstacleBelow) {
  for (const std::string element : {"P2", "P3"}) {
    const TemporaryFolder folder;
    const SceneRun run(scene_on(
        named_square(folder, 4),
        "[contact]\ngap = \"-0.1 - 0.1*x\"\n" + edge("left", "traction = \"-0.1*(1 - y)\"") +
            edge("right", "traction = \"0.1*(1 - y)\"") + edge("top", "displacement = \"0\""),
        element));
    const auto s = run.summary();
    // the tolerance of the solve is 1e-10
    EXPECT_NEAR(s["contact_force"]["normal"].get<double>(), 0.15, 1e-9) << element;
    EXPECT_NEAR(s["contact_force"]["moment"].get<double>(), 1.0 / 20 + 1.0 / 30, 1e-9) << element;
    EXPECT_EQ(s["contact"]["from_within"], (nlohmann::json{0.0, 0.0})) << element;
    EXPECT_EQ(s["contact"]["to_within"], (nlohmann::json{1.0, 1.0})) << element;
  }
}

// The same with an accuracy: phi = 1 - y is 1 on Gamma_C and 0 where u is prescribed, and |phi|_a
// is 1. So the half width of the interval is the bound of the flux, which is some 0.1 |u|_a here.
TEST(Bodies, ProveForceAndMomentOfTheObstacleBelow) {
  const TemporaryFolder folder;
  const SceneRun run(scene_on(named_square(folder, 4),
                              "[contact]\ngap = \"-0.1 - 0.1*x\"\n" +
                                  edge("left", "traction = \"-0.1*(1 - y)\"") +
                                  edge("right", "traction = \"0.1*(1 - y)\"") +
                                  edge("top", "displacement = \"0\""),
                              "CR") +
                     "accuracy = 0.1\n");
  const auto s = run.summary();
  const auto& force = s["contact_force"];
  const double energy_norm = std::sqrt(0.07 / 3 + 0.01 / 3);  // int u_y^2 + int u_x^2
  for (const auto& [name, exact, phi] :
       {std::tuple{"normal", 0.15, 1.0}, {"moment", 1.0 / 20 + 1.0 / 30, 0.8}}) {
    const auto& proved = force[std::string(name) + "_proved"];
    ASSERT_TRUE(proved.is_array()) << name << ": " << run.outcome.err;
    const double low = proved[0], high = proved[1];
    EXPECT_LE(low, exact) << name;
    EXPECT_GE(high, exact) << name;
    EXPECT_NEAR((low + high) / 2, force[name].get<double>(), 1e-9) << name;
    EXPECT_GT(high - low, 0.01 * energy_norm * phi) << name;
    EXPECT_LT(high - low, 2 * 0.15 * energy_norm * phi) << name;
  }
}

// Clamped sides end at Gamma_C: no function of finite energy is 1 on it and 0 beside it.
TEST(Bodies, ProveNoForceBesideAClampedEnd) {
  const SceneRun run(
      "[load]\nf = \"-1\"\n[contact]\n[mesh]\nkind = \"structured\"\ncells = 4\n"
      "[method]\naccuracy = 0.3\n");
  const auto s = run.summary();
  EXPECT_GT(s["contact_force"]["normal"].get<double>(), 0);
  EXPECT_TRUE(s["contact_force"]["normal_proved"].is_null());
  EXPECT_TRUE(s["contact_force"]["moment_proved"].is_null());
}

// u = -0.1 (1 - y): the obstacle above presses down with the force 0.1.
TEST(Bodies, KnowTheSignOfTheForceOfACeiling) {
  for (const std::string element : {"P1", "CR"}) {
    const TemporaryFolder folder;
    const SceneRun run(scene_on(named_square(folder, 4),
                                "[contact]\ngap = \"1\"\nceiling = \"-0.1\"\n" +
                                    edge("left", "free = true") + edge("right", "free = true") +
                                    edge("top", "displacement = \"0\""),
                                element));
    const auto s = run.summary();
    EXPECT_NEAR(s["contact_force"]["normal"].get<double>(), -0.1, 1e-9) << element;
    EXPECT_NEAR(s["contact_force"]["moment"].get<double>(), -0.05, 1e-9) << element;
  }
}

// u_x is 1 in a half of stiffness 1 and 0.1 in one of 10 under the traction 1, by a formula or per
// group.
TEST(Bodies, AreAsStiffAsTheirPartsAre) {
  for (const std::string stiffness :
       {"\"1 + 9*(x > 0.5)\"", "{ body = 1, stiff = 10 }", "{ stiff = 10 }"}) {
    const TemporaryFolder folder;
    const SceneRun run(scene_on(named_square(folder, 4, stiffness.front() == '{'),
                                "[body]\nstiffness = " + stiffness + "\n" +
                                    edge("left", "displacement = \"0\"") +
                                    edge("right", "traction = \"1\"") + edge("top", "free = true"),
                                "CR"));
    if (stiffness == "{ stiff = 10 }") {
      EXPECT_NE(run.outcome.err.find("body.stiffness: names no group of the surface at"),
                std::string::npos);
      continue;
    }
    EXPECT_NEAR(run.summary()["u_max"].get<double>(), 0.55, 1e-12) << stiffness;
    EXPECT_EQ(read_scene_file(run.scene_path).scene.body().stiffness(0.9, 1.05), 10)
        << "a refined curve goes there";
  }
}

// A body and a layer twice as stiff under twice the load move alike; a ceiling is a floor upside
// down.
TEST(Bodies, ScaleAndTurnRound) {
  const auto asked = [](const std::string& sections, const char* f) {
    return SceneRun(fmt::format("[load]\nf = \"{}\"\n{}[mesh]\nkind = \"structured\"\ncells = 8\n",
                                f, sections))
        .summary();
  };
  const auto one = asked("[layer]\nepsilon = 0.1\n[contact]\n", "10*sin(2*pi*x)"),
             two = asked(
                 "[body]\nstiffness = \"2\"\n[layer]\nthickness = 0.1\nstiffness = 20\n[contact]\n",
                 "20*sin(2*pi*x)"),
             below = asked("[contact]\ngap = \"0.01\"\n", "-5"),
             above = asked("[contact]\ngap = \"1\"\nceiling = \"0.01\"\n", "5");
  EXPECT_NEAR(two["u_max"].get<double>(), one["u_max"].get<double>(), 1e-12);
  EXPECT_NEAR(two["energy"].get<double>(), 2 * one["energy"].get<double>(), 1e-12);
  EXPECT_NEAR(above["u_max"].get<double>(), -below["u_min"].get<double>(), 1e-12);
  EXPECT_EQ(above["contact"]["active"], below["contact"]["active"]);
  EXPECT_GT(above["contact"]["active"].get<int>(), 0);
}

TEST(Bodies, GrowTheirLayer) {
  const OnMesh body(structured_mesh(8, {0}), "[layer]\nepsilon = 0.1\n[contact]\n",
                    "10*sin(2*pi*x)");
  const OnMesh both(extruded(structured_mesh(8, {0}), 0.1), "[layer]\nepsilon = 0.1\n[contact]\n",
                    "10*sin(2*pi*x)");
  ASSERT_EQ(body.run->outcome.status, 0) << body.run->outcome.err;
  EXPECT_EQ(body.energy(), both.energy());
}

TEST(Bodies, InPlaneStrainAreWhatTheLibrarySolves) {
  const std::string pressed =
      "[contact]\ngap = \"(x - 0.5)^2\"\n[mesh]\nkind = \"structured\"\ncells = 8\n"
      "[method]\nelement = \"CR\"\n[load]\nf = \"x - 1\"\n";
  const auto gap = [](double x) { return (x - 0.5) * (x - 0.5); };
  const auto expect = [&](const std::string& sections, VariationalInequality problem,
                          const Space& space) {
    problem.load.tail(space.size()) = load_vector(space, [](double x, double) { return x - 1; });
    const SceneRun run(pressed + sections);
    const Solution direct = active_set(problem);
    EXPECT_EQ(run.summary()["u_max"].get<double>(), direct.u.maxCoeff());
    const Csv contact = read_csv(run.results / "contact.csv");
    EXPECT_NEAR(contact.rows.col(2).sum() / 8, direct.lambda.head(8).sum(), 1e-12);
    ASSERT_EQ(contact.rows.cols(), problem.bounds.unknowns.size() > 8 ? 4 : 3)
        << "a column where friction acts";
    if (contact.rows.cols() == 4) {
      EXPECT_NEAR((contact.rows.col(3) / 8 - direct.lambda.tail(8)).lpNorm<Eigen::Infinity>(), 0,
                  1e-12);
      EXPECT_NEAR(contact.rows.col(3).lpNorm<Eigen::Infinity>(), 0.05, 1e-12)
          << "it slides somewhere";
    }
  };
  const TriangleMesh square = with_free_sides(structured_mesh(8, {0})),
                     coated = with_free_sides(structured_mesh(8));
  const Space on_square(square, crouzeix_raviart()), on_coated(coated, crouzeix_raviart());
  PlaneStrain rubber;
  rubber.gap = gap;
  rubber.epsilon = 1e-3;
  expect("[model]\nkind = \"plane strain\"\nepsilon = 1e-3\n",
         assemble(rubber, {on_square, on_square}), on_square);
  rubber.friction = [](double) { return 0.05; };
  expect("[model]\nkind = \"plane strain\"\nepsilon = 1e-3\nfriction = \"0.05\"\n",
         assemble(rubber, {on_square, on_square}), on_square);
  rubber.friction = {};
  rubber.epsilon = 1e-8;
  expect("[model]\nkind = \"plane strain\"\n", assemble(rubber, {on_square, on_square}), on_square);
  Coating coating;
  coating.gap = gap;
  coating.thickness = 1e-3;
  coating.prescribed_displacement = 0.05;
  const std::string less = "[model]\nkind = \"plane strain\"\npush = 0.05\n[layer]\n";
  expect(less + "epsilon = 1e-3\n", assemble(coating, {on_coated, on_coated}), on_coated);
  coating.layer = {2 * coating.body.lambda, 2 * coating.body.mu};
  expect(less + "thickness = 1e-3\nstiffness = 2e3\n", assemble(coating, {on_coated, on_coated}),
         on_coated);

  const SceneFile file = read_scene(pressed + "[model]\nkind = \"plane strain\"\n", "scene.toml");
  EXPECT_GT(std::get<RubberModel>(file.model).pressure(solve_scene(file, {}).result).mean(), 0)
      << "rubber that is pressed";
}

TEST(Bodies, ThatLockInPlaneStrainSaySo) {
  const std::string rubber = "[model]\nkind = \"plane strain\"\nepsilon = ",
                    coating = "[model]\nkind = \"plane strain\"\n[layer]\nepsilon = ";
  for (const auto& [body, epsilon, mesh, element, locks] :
       {std::tuple{coating, "1e-4", "unstructured", "P1", true},
        {coating, "0.2", "unstructured", "P1", true},
        {coating, "1", "unstructured", "P1", false},
        {coating, "1e-4", "structured", "P1", false},
        {rubber, "1e-4", "structured", "P1", true},
        {rubber, "1e-4", "structured", "CR", false},
        {rubber, "1e-4", "structured", "P2", false},
        {rubber, "1", "structured", "P1", false}}) {
    const SceneRun run(
        fmt::format("{}{}\n[load]\nf = \"0\"\n[contact]\n[mesh]\nkind = \"{}\"\ncells = 8\n"
                    "[method]\nelement = \"{}\"\n",
                    body, epsilon, mesh, element));
    const std::string warning = run.summary()["warning"];
    EXPECT_EQ(warning.find("locks") != warning.npos, locks)
        << body << epsilon << mesh << element << warning;
  }
}

TEST(Bodies, RefuseWhatTheirGroupsDoNotSay) {
  const TemporaryFolder folder;
  const std::string square = named_square(folder, 2), left = edge("left", "displacement = \"0\""),
                    right = edge("right", "free = true"), top = edge("top", "free = true");
  const std::vector<std::pair<std::string, std::string>> bad{
      {left + right, "group \"top\""},
      {left + right + edge("tpo", "free = true"),
       "group \"top\"; accepted: clamped, contact, left, right, sigma, tpo, and"},
      {left + right + top + edge("hole", "free = true"), "has no curve in the group \"hole\""},
      {left + right + top + top, "edge[3].group: \"top\" has its condition already"},
      {left + right + edge("clamped", "free = true"), "\"clamped\" has its condition already"},
      {left + right + edge("top", "free = true\nspring = \"1\""),
       "has 2 conditions; accepted: exactly one"},
      {left + right + edge("top", "free = false"), "free: is not true"},
      {left + right + edge("top", "pull = \"1\""), "edge[2].pull: unknown key"},
      {left + right + edge("top", "traction = \"z\""), "edge[2].traction"},
      {left + right + edge("top", "spring = \"-1\""), "edge[2].spring: is -1 at"},
      {left + right + top + "[body]\nstiffness = \"x - 1\"\n", "body.stiffness: is "},
      {left + right + top + "[body]\nstiffness = \"0*x\"\n", "body.stiffness: is 0 at"},
      {left + right + top + "[body]\nstiffness = { soft = 1 }\n", "soft"},
      {left + right + top + "[at]\npoints = [[2, 2]]\n", "at.points: (2, 2) is outside"},
      {left + right + top + "[at]\npoints = [1]\n", "at.points: has an entry that is no place"}};
  for (const auto& [sections, what] : bad)
    expect_no_answer(SceneRun(scene_on(square, sections, "CR")), what);
}

TEST(Bodies, BeyondThePaperAreRefusedByTheDoorsThatDoNotKnowThem) {
  for (const std::string name : {"coated_arch", "pressed_rubber"}) {
    const TemporaryFolder folder;
    const Outcome outcome =
        run_antilock("sweep " + in_shell(std::string(EXAMPLE_SCENES) + "/" + name + ".toml") +
                         " --epsilon 1:1e-2:2",
                     folder);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("sweep: does not know "), outcome.err.npos) << outcome.err;
  }
}

TEST(Bodies, OnACurvedGammaCAreRefusedWhatTheyHaveNoAnswerFor) {
  const std::string scenes = EXAMPLE_SCENES, scene = contents(scenes + "/coated_arch.toml");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = scene;
    for (const auto& [a, b] : {std::pair<std::string, std::string>{
                                   "\"coated_arch.msh", "\"" + scenes + "/coated_arch.msh"},
                               {from, to}})
      text.replace(text.find(a), a.size(), b);
    return SceneRun(text);
  };
  const std::string element = "element = \"CR\"";
  for (const auto& [from, to, what] :
       {std::tuple{element, std::string("accuracy = 0.1"),
                   "do not go with an accuracy asked of a layer"},
        {std::string("traction = \"-0.3 + 0.2*x\""),
         std::string("free = true\n[model]\nkind = \"plane strain\""),
         "do not go with plane strain"},
        {std::string("[contact]"), std::string("load = \"1\"\n[contact]"),
         "do not go with a load on the layer"},
        {std::string("thickness = 0.05"), std::string("thickness = 0.65"), "meets itself"}})
    expect_no_answer(with(from, to), what);
}

TEST(Bodies, WhoseLayerDoesNotFitThemAreRefused) {
  expect_no_answer(*OnMesh(bridge(8), "[layer]\nepsilon = 0\nmodel = \"ventcel\"\n", "1").run,
                   "one piece");
  expect_no_answer(*OnMesh(structured_mesh(8, {0.5}), "[layer]\nepsilon = 1e-3\n", "1").run,
                   "accepted for this scene: the strip");
}

// At a tiny epsilon an edge that is 1e-9 off the vertical would tie what a column holds apart.
TEST(Bodies, OnColumnsWithRoundedCoordinatesDoNotLock) {
  TriangleMesh mesh = extruded(unstructured_mesh(8, {0}), 1);
  const auto answer = [&] {
    return OnMesh(mesh, "[layer]\nepsilon = 1e-10\n[contact]\n", "10*sin(2*pi*x)", "P1");
  };
  const double exact = answer().energy();
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (double& x = mesh.vertices(v, 0); mesh.vertices(v, 1) < 0 && x > 0 && x < 1)
      x += 1e-9 * std::sin(7 * v);
  const OnMesh rounded = answer();
  ASSERT_EQ(rounded.run->outcome.status, 0) << rounded.run->outcome.err;
  EXPECT_NEAR(rounded.energy(), exact, 1e-10 * std::abs(exact)) << "the vertices are put back";
  EXPECT_EQ(rounded.run->summary()["warning"], "");
}

}  // namespace antilock::test::bodies_test
