// Scenes in space: their answers are those of the library called directly, their files can be read
// back, and each key of the plane is refused.
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "antilock/analysis/solve.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/read_msh.hpp"
#include "antilock/mesh/write_msh.hpp"
#include "antilock/runner/scene_mesh.hpp"
#include "antilock/runner/scene_results.hpp"
#include "antilock/runner/solve_scene.hpp"
#include "scenes/runner.hpp"
#include "support/scenes.hpp"
#include "support/vtu_array.hpp"

namespace antilock::test::three_dimensions_test {

constexpr CellKind kind = CellKind::tetrahedron;
const std::string f = "10*sin(2*pi*x)*sin(pi*y)*(1 + z)";
double load(double x, double y, double z) {
  return 10 * std::sin(2 * std::numbers::pi * x) * std::sin(std::numbers::pi * y) * (1 + z);
}
double gap(double x, double y) { return 0.001 * (x + 2 * y); }

std::string scene(const std::string& effects, const std::string& mesh, const std::string& element,
                  const std::string& formula = f) {
  return fmt::format(
      "[load]\nf = \"{}\"\n{}[mesh]\ndimension = 3\n{}\n[method]\nelement = \"{}\"\n", formula,
      effects, mesh, element);
}
std::string made(const std::string& kind_of_mesh, int cells) {
  return fmt::format("kind = \"{}\"\ncells = {}", kind_of_mesh, cells);
}
const std::string layer_and_contact = "[layer]\nepsilon = 0.05\n[contact]\n";

Result answer(const std::string& text) { return solve_scene(read_scene(text, "scene"), {}).result; }

TEST(ThreeDimensions, AnswerAsTheLibraryDoes) {
  const Scene direct({load}, StiffLayer{0.05}, UnilateralContact{gap});
  const std::map<std::string, Mesh> meshes{{"structured", structured_mesh(3, {1, kind})},
                                           {"unstructured", unstructured_mesh(3, {1, kind})},
                                           {"layered", layered_mesh(3, 0.05, kind)}};
  std::ptrdiff_t active = 0;
  for (const auto& [name, mesh] : meshes)
    for (const std::string used : {"P1", "CR"}) {
      const std::string effects = layer_and_contact + "gap = \"0.001*(x + 2*y)\"\n";
      const Result found = answer(scene(effects, made(name, 3), used));
      const Space space(mesh, element(used, kind));
      ASSERT_TRUE(have_one_mesh(found.space, space)) << name;
      const Solution expected = active_set(assemble(direct, space));
      active += std::count(expected.active.begin(), expected.active.end(), true);
      // both are solved to 1e-10
      EXPECT_LT(relative_difference(found.solution.u, expected.u), 1e-9) << name << " " << used;
      EXPECT_EQ(found.solution.active, expected.active);
    }
  EXPECT_GT(active, 0);
}

TEST(ThreeDimensions, HaveTheTrueLayerAndTheBodyAlone) {
  const Domain thin{0.25, kind}, alone{0, kind};
  for (const bool layer : {false, true}) {
    const Scene direct =
        layer ? Scene({load}, ThinLayer{0.25}) : Scene({load}, NoLayer{}, UnilateralContact{});
    const std::string effects =
        layer ? "[layer]\nmodel = \"thin\"\nepsilon = 0.25\n" : "[contact]\n";
    const Result found = answer(scene(effects, made("structured", 4), "P1"));
    const Space space(structured_mesh(4, layer ? thin : alone), p1(kind));
    EXPECT_LT(relative_difference(found.solution.u, active_set(assemble(direct, space)).u), 1e-9);
  }
}

/// The mesh in a file, with the group sides in place of clamped.
std::string cube(const TemporaryFolder& folder, Mesh mesh) {
  for (EdgeTag& tag : mesh.edge_tag)
    if (tag == EdgeTag::clamped) tag = dirichlet_group(0);
  const std::string path = (folder / "cube.msh").string();
  write_msh(path, mesh, {{"sides"}});
  return path;
}
std::string on_file(const std::string& path) { return "kind = \"file\"\nfile = \"" + path + "\""; }
std::string sides(const std::string& u) {
  return "[[edge]]\ngroup = \"sides\"\ndisplacement = \"" + u + "\"\n";
}

// u = 1 + 2 x - y + 3 z is prescribed on all sides but the bottom, and a ceiling at its values
// holds it down on the bottom. It is in every space. On the bottom the outward derivative is -3,
// and so is the pressure.
TEST(ThreeDimensions, PassThePatchTest) {
  const TemporaryFolder folder;
  const std::string at = "[at]\npoints = [[0.3, 0.41, 0.77], [0, 1, 0.5], [0.25, 0.5, 0]]\n";
  const std::string effects = sides("1 + 2*x - y + 3*z") + at;
  const std::string contact = "[contact]\nceiling = \"1 + 2*x - y\"\ngap = \"9\"\n";
  for (const Mesh& mesh : {structured_mesh(3, {0, kind}), unstructured_mesh(3, {0, kind})}) {
    const std::string path = cube(folder, mesh);
    for (const std::string used : {"P1", "CR"}) {
      const SceneRun run(scene(effects + contact, on_file(path), used, "0"));
      const auto summary = run.summary();
      const Csv solution = read_csv(run.results / "solution.csv");
      ASSERT_EQ(solution.header, "x,y,z,u");
      for (const auto& row : solution.rows.rowwise())
        EXPECT_NEAR(row(3), 1 + 2 * row(0) - row(1) + 3 * row(2), 1e-9);
      ASSERT_EQ(summary["at"].size(), 3U);
      for (const auto& point : summary["at"]) {
        const double x = point["x"], y = point["y"], z = point["z"];
        EXPECT_NEAR(point["u"].get<double>(), 1 + 2 * x - y + 3 * z, 1e-9);
      }
      const Csv table = read_csv(run.results / "contact.csv");
      ASSERT_EQ(table.header, "x,y,gap,pressure");
      for (const double pressure : table.rows.col(3)) EXPECT_NEAR(pressure, -3, 1e-8);
      EXPECT_EQ(summary["warning"], "");
    }
  }
}

// The mesh of Kuhn is its own mirror image in x = y.
TEST(ThreeDimensions, HaveASymmetricAnswerToSymmetricData) {
  const std::string effects = "[layer]\nepsilon = 0.01\n[contact]\ngap = \"0.02*x*y\"\n";
  const SceneRun run(scene(effects, made("structured", 5), "CR", "5*(2*x*y - x - y + z)"));
  const auto summary = run.summary();
  std::map<std::array<long, 3>, double> u;
  const Csv solution = read_csv(run.results / "solution.csv");
  const auto place = [](double x, double y, double z) {
    return std::array{std::lround(1e6 * x), std::lround(1e6 * y), std::lround(1e6 * z)};
  };
  for (const auto& row : solution.rows.rowwise()) u[place(row(0), row(1), row(2))] = row(3);
  const double size = solution.rows.col(3).lpNorm<Eigen::Infinity>();
  for (const auto& row : solution.rows.rowwise())
    EXPECT_NEAR(u.at(place(row(1), row(0), row(2))), row(3), 1e-8 * size);
  const auto& zone = summary["contact"];
  ASSERT_GT(zone["active"].get<int>(), 0);
  EXPECT_NEAR(zone["from"].get<double>(), zone["y_from"].get<double>(), 1e-12);
  EXPECT_NEAR(zone["to"].get<double>(), zone["y_to"].get<double>(), 1e-12);
  const auto& force = summary["contact_force"];
  EXPECT_NEAR(force["moment"].get<double>(), force["moment_y"].get<double>(),
              1e-8 * std::abs(force["moment"].get<double>()));
}

// A row of contact.csv is a face of Gamma_C, of the area 1 / (2 n^2).
TEST(ThreeDimensions, AddUpTheContactForce) {
  constexpr int n = 4;
  const SceneRun run(scene(layer_and_contact, made("structured", n), "CR"));
  const auto summary = run.summary();
  const Csv table = read_csv(run.results / "contact.csv");
  ASSERT_EQ(table.rows.rows(), 2 * n * n);
  const Eigen::VectorXd force = table.rows.col(3) / (2 * n * n);
  const auto& found = summary["contact_force"];
  const double size = force.sum();
  EXPECT_GT(size, 0);
  EXPECT_NEAR(found["normal"].get<double>(), size, 1e-8 * size);
  EXPECT_NEAR(found["moment"].get<double>(), force.dot(table.rows.col(0)), 1e-8 * size);
  EXPECT_NEAR(found["moment_y"].get<double>(), force.dot(table.rows.col(1)), 1e-8 * size);
  double least = 1, most = 0;
  for (const auto& row : table.rows.rowwise())
    if (row(3) > 0) {
      least = std::min(least, row(1));
      most = std::max(most, row(1));
    }
  EXPECT_EQ(summary["contact"]["y_from"].get<double>(), least);
  EXPECT_EQ(summary["contact"]["y_to"].get<double>(), most);
  EXPECT_NE(run.outcome.out.find("integral of y pressure"), std::string::npos);
  EXPECT_NE(run.outcome.out.find("render cut "), std::string::npos) << run.outcome.out;
}

// The values of the picture are those of the tables: P1 has a point per vertex, CR four for each
// tetrahedron, whose mean over the corners of a face is the value at its centroid.
TEST(ThreeDimensions, WriteAPictureThatIsTheAnswer) {
  for (const std::string used : {"P1", "CR"}) {
    const SceneRun run(scene(layer_and_contact, made("structured", 2), used));
    const std::string vtu = contents(run.results / "solution.vtu");
    const Csv solution = read_csv(run.results / "solution.csv");
    const std::vector<double> u = vtu_array(vtu, "u"), points = vtu_array(vtu, "points");
    ASSERT_EQ(points.size(), 3 * u.size());
    EXPECT_EQ(vtu_array(vtu, "types"), std::vector<double>(96, 10));  // VTK_TETRA
    if (used == "P1") {
      ASSERT_EQ(solution.rows.rows(), std::ssize(u));
      for (std::size_t i = 0; i < u.size(); ++i)
        EXPECT_EQ(u[i], solution.rows(static_cast<Eigen::Index>(i), 3));
      continue;
    }
    const Space space(read_msh((run.results / "mesh.msh").string()), crouzeix_raviart(kind));
    ASSERT_EQ(std::ssize(u), 4 * space.mesh().triangle_count());
    for (int t = 0; t < space.mesh().triangle_count(); ++t)
      for (int i = 0; i < 4; ++i) {
        double mean = 0;
        for (const int k : reference_cell(kind).facet[i]) mean += u[4 * t + k] / 3;
        EXPECT_NEAR(mean, solution.rows(space.cell_dofs()(t, i), 3), 1e-14);
      }
  }
}

TEST(ThreeDimensions, SayWhetherTheLayerLocks) {
  const std::string effects = "[layer]\nepsilon = 1e-6\n[contact]\n";
  const Result locked = answer(scene(effects, made("unstructured", 4), "P1"));
  EXPECT_NE(locked.warning.find("P1 locks in this layer: it loses at least 99 %"),
            std::string::npos)
      << locked.warning;
  EXPECT_NE(locked.warning.find("(proved)"), std::string::npos) << locked.warning;
  // a load on the layer is integrated on two meshes, and the proof leaves this error out
  const Result loaded = answer(scene("[layer]\nepsilon = 1e-6\nload = \"1 + x\"\n[contact]\n",
                                     made("unstructured", 4), "P1"));
  EXPECT_NE(loaded.warning.find("it loses about 99 %"), std::string::npos) << loaded.warning;
  // nothing locks at epsilon = 1
  EXPECT_EQ(
      answer(scene("[layer]\nepsilon = 1\n[contact]\n", made("unstructured", 4), "P1")).warning,
      "");
  for (const std::string name : {"structured", "layered"})
    EXPECT_EQ(answer(scene(effects, made(name, 4), "P1")).warning, "");
  const SceneRun run(scene(effects, made("unstructured", 3), "CR"));
  const auto summary = run.summary();
  EXPECT_NE(summary["locking"]["diagnosis"].get<std::string>().find("CR"), std::string::npos);
  EXPECT_TRUE(summary["locking"]["kept"].is_null());
}

// A file with tetrahedra needs no dimension. A body alone gets its layer below its bottom.
TEST(ThreeDimensions, ReadAMeshFromAFile) {
  const TemporaryFolder folder;
  const std::string body = (folder / "body.msh").string(), both = (folder / "both.msh").string();
  write_msh(body, unstructured_mesh(3, {0, kind}));
  write_msh(both, layered_mesh(3, 0.05, kind));
  std::vector<Eigen::VectorXd> found;
  for (const std::string& path : {body, both}) {
    const std::string text = scene(layer_and_contact, on_file(path), "CR");
    found.push_back(answer(text).solution.u);
    std::string without = text;
    without.erase(without.find("dimension = 3\n"), 14);
    EXPECT_EQ(answer(without).solution.u, found.back());
  }
  ASSERT_EQ(found[0].size(), found[1].size());
  EXPECT_LT(relative_difference(found[0], found[1]), 1e-9);
}

// Two groups of volumes have the stiffnesses that a formula says as well.
TEST(ThreeDimensions, HaveAStiffnessForEachGroupOfVolumes) {
  const TemporaryFolder folder;
  const Mesh mesh = structured_mesh(4, {0, kind});
  const std::string path = (folder / "one.msh").string(), parts = (folder / "two.msh").string();
  write_msh(path, mesh);
  std::istringstream lines(contents(path));
  std::ofstream two(parts);
  int cell = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line == "3 1 \"body\"") line = "3 1 \"left\"\n3 7 \"right\"";
    if (line == "$PhysicalNames") {
      std::string count;
      std::getline(lines, count);
      line += fmt::format("\n{}", std::stoi(count) + 1);
    }
    // number type tags group entity vertices
    const std::size_t at = line.find(" 4 2 1 1 ");
    if (at != std::string::npos && centroid(mesh, cell++)(0) > 0.5)
      line.replace(at, 9, " 4 2 7 7 ");
    two << line << '\n';
  }
  two.close();
  const std::string contact = "[contact]\n";
  const Result grouped = answer(
      scene("[body]\nstiffness = { left = 1, right = 10 }\n" + contact, on_file(parts), "P1"));
  const Result formula =
      answer(scene("[body]\nstiffness = \"x > 0.5 ? 10 : 1\"\n" + contact, on_file(path), "P1"));
  EXPECT_LT(relative_difference(grouped.solution.u, formula.solution.u), 1e-12);
}

TEST(ThreeDimensions, WarnOfDataThatTheMeshMisses) {
  const std::string spike = "(abs(x - 0.31) < 0.02 && abs(y - 0.37) < 0.02) ? 1 : 0";
  EXPECT_NE(answer(scene("", made("structured", 3), "P1", spike)).warning.find("misses the load"),
            std::string::npos);
  // the samples fill each tetrahedron evenly: the integrals of a smooth load are those of the rule
  EXPECT_EQ(answer(scene("", made("structured", 1), "P2", "exp(x + 2*y + 3*z)")).warning, "");
  const std::string thorn =
      "[contact]\ngap = \"(abs(x - 0.4) < 0.02 && abs(y - 0.45) < 0.02) ? -5 : 0.1\"\n";
  for (const std::string used : {"P1", "CR"}) {
    const std::string warning = answer(scene(thorn, made("structured", 3), used)).warning;
    EXPECT_NE(warning.find("the mesh misses the obstacle"), std::string::npos) << warning;
    EXPECT_NE(warning.find("at x, y = 0."), std::string::npos) << warning;
  }
}

// u_h of Crouzeix-Raviart may sink into a smooth obstacle beside the centroids of the faces, where it
// is bounded. This is its error, and not an obstacle that the mesh misses.
TEST(ThreeDimensions, DoNotWarnOfASmoothObstacle) {
  const std::string slope = "[contact]\ngap = \"0.001 + 0.05*x + 0.02*y\"\n";
  for (const std::string name : {"structured", "unstructured"})
    for (const std::string used : {"P1", "CR"}) {
      const Result found = answer(scene(slope, made(name, 4), used, "10*sin(2*pi*x)"));
      EXPECT_GT(std::count(found.solution.active.begin(), found.solution.active.end(), true), 0);
      EXPECT_EQ(found.warning, "") << name << " " << used;
    }
}

TEST(ThreeDimensions, WarnOfDisplacementsThatJump) {
  const TemporaryFolder folder;
  Mesh mesh = structured_mesh(2, {0, kind});
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] == EdgeTag::clamped) {
      double lowest = 1;
      for (const int v : mesh.edges.row(e)) lowest = std::min(lowest, mesh.vertices(v, 2));
      mesh.edge_tag[e] = dirichlet_group(lowest == 1 ? 1 : 0);
    }
  const std::string path = (folder / "cube.msh").string();
  write_msh(path, mesh, {{"sides"}, {"top"}});
  const auto warning = [&](const std::string& top) {
    const std::string edges =
        sides("x*y") + "[[edge]]\ngroup = \"top\"\ndisplacement = \"" + top + "\"\n";
    return answer(scene(edges, on_file(path), "P1", "0")).warning;
  };
  EXPECT_EQ(warning("x*y*z"), "");
  EXPECT_NE(warning("x*y + 1").find("where they meet"), std::string::npos);
  EXPECT_NE(warning("x < 0.3 ? x*y : x*y + 1").find("no function of finite energy"),
            std::string::npos);
}

struct Refused {
  std::string key;
  std::string text;
  std::string accepted;
};

TEST(ThreeDimensions, RefuseThePartsOfThePlane) {
  const TemporaryFolder folder;
  const std::string path = (folder / "cube.msh").string(), flat = (folder / "flat.msh").string();
  write_msh(path, structured_mesh(2, {0, kind}));
  write_msh(flat, structured_mesh(2, {0}));
  const std::string mesh = made("structured", 2);
  const auto with_mesh = [&](const std::string& lines) { return scene("", lines, "P1"); };
  const auto with_method = [&](const std::string& lines) {
    return scene("", mesh, "P1") + lines + "\n";
  };
  const std::vector<Refused> all{
      {"mesh.dimension", "[load]\nf = \"1\"\n[mesh]\ndimension = 4\n" + mesh, "2 to 3"},
      {"mesh.dimension", "[load]\nf = \"1\"\n[mesh]\ndimension = 1\n" + mesh, "2 to 3"},
      {"mesh.dimension", "[load]\nf = \"1\"\n[mesh]\ndimension = 2.5\n" + mesh, "2 to 3"},
      {"mesh.dimension", "[load]\nf = \"1\"\n[mesh]\ndimension = \"3\"\n" + mesh, "2 to 3"},
      {"mesh.cells", with_mesh(made("structured", 129)), "1 to 128"},
      {"mesh.cells", with_mesh(made("unstructured", 65)), "1 to 64"},
      {"mesh.refinements", with_mesh(mesh + "\nrefinements = 1"), "no refinements"},
      {"mesh.geometry", with_mesh(on_file(path) + "\ngeometry = \"a.geo\""), "no geometry"},
      {"mesh.dimension", with_mesh(on_file(flat)), "2, or another file"},
      {"mesh.kind", with_mesh(made("layered", 2)), "unstructured"},
      {"layer.model", scene("[layer]\nepsilon = 0\nmodel = \"ventcel\"\n", mesh, "P1"), "\"thin\""},
      {"layer.epsilon",
       scene("[layer]\nepsilon = 0.019\nmodel = \"thin\"\n", made("unstructured", 2), "P1"),
       "0.02 or more"},
      {"model.kind", scene("[model]\nkind = \"plane strain\"\n", mesh, "P1"), "\"anti-plane\""},
      {"contact", scene("[contact]\nslave = \"a\"\nmaster = \"b\"\n", on_file(path), "P1"),
       "a gap"},
      {"method.element", scene("", mesh, "P3"), "\"P1\", \"P2\", \"CR\""},
      {"method.element", scene("", mesh, "M2"), "\"P1\", \"P2\", \"CR\""},
      {"method.element", scene("[contact]\n", mesh, "P2"), "\"P1\", \"CR\""},
      {"method.element", scene("[contact]\n", mesh, "P3"), "accepted: \"P1\", \"CR\""},
      {"method.solver", with_method("solver = \"petsc\""), "\"active-set\", \"uzawa\""},
      {"method.accuracy", with_method("accuracy = 0.1"), "none"},
      {"method.of", with_method("of = \"stress\""), "none"},
      {"load.f", scene("", mesh, "P1", "t"), "x, y and z"},
      {"load.f", scene("", mesh, "P1", "1/(z - 0.5)"), "finite values"},
      {"contact.gap", scene("[contact]\ngap = \"z\"\n", mesh, "P1"), "in x and y"},
      {"contact.gap", scene("[contact]\ngap = \"y - 0.5\"\n", mesh, "P1"), "gap >= -u"},
      // 0.1 at the vertices of Gamma_C, and -0.2 between them on its clamped edges
      {"contact.gap", scene("[contact]\ngap = \"0.1 - 0.3*sin(2*pi*x)^2\"\n", mesh, "P1"),
       "gap >= -u"},
      {"contact.ceiling",
       scene("[contact]\ngap = \"9\"\nceiling = \"0.1 - 0.3*sin(2*pi*y)^2\"\n", mesh, "CR"),
       "ceiling >= u"},
      {"contact.gap", scene("[contact]\ngap = \"1/(y - 0.3)\"\n", mesh, "P1"), "finite values"},
      {"contact.ceiling", scene("[contact]\nceiling = \"0.3 - y\"\n", mesh, "P1"), "ceiling >="},
      {"at.points", scene("[at]\npoints = [[0.5, 0.5]]\n", mesh, "P1"), "[[0.25, 0.5, -1.0]]"},
      {"body.stiffness", scene("[body]\nstiffness = \"z - 0.5\"\n", mesh, "P1"), "above 0"},
      {"edge", scene("[[edge]]\ngroup = \"a\"\nfree = true\n", mesh, "P1"), "kind = \"file\""},
  };
  for (const auto& [key, text, accepted] : all) {
    const std::string message = refusal([&] { answer(text); });
    EXPECT_TRUE(message.starts_with("scene: " + key + ": ")) << key << ": " << message;
    EXPECT_NE(message.find("accepted: "), std::string::npos) << message;
    EXPECT_NE(message.find(accepted), std::string::npos) << message << "\nfor " << accepted;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

// In the plane z is unknown, and a point has two coordinates, as before.
TEST(ThreeDimensions, LeaveThePlaneAsItIs) {
  const std::string text = "[load]\nf = \"{}\"\n{}[mesh]\nkind = \"structured\"\ncells = 2\n{}";
  const auto refused = [&](const std::string& formula, const std::string& more,
                           const std::string& of_mesh) {
    return refusal(
        [&] { read_scene(fmt::format(fmt::runtime(text), formula, more, of_mesh), "scene"); });
  };
  for (const std::string of_mesh : {"", "dimension = 2\n"}) {
    EXPECT_NE(refused("z", "", of_mesh).find("\"z\" is unknown"), std::string::npos);
    EXPECT_NE(refused("1", "[contact]\ngap = \"y\"\n", of_mesh).find("\"y\" is unknown"),
              std::string::npos);
    EXPECT_NE(refused("1", "[at]\npoints = [[0, 0, 0]]\n", of_mesh).find("[[0.25, -1.0]]"),
              std::string::npos);
  }
}

TEST(ThreeDimensions, SayTheAreaOfAFaceWhereASpringIsTooStiff) {
  const TemporaryFolder folder;
  Mesh mesh = structured_mesh(2, {0, kind});
  for (int e = 0; e < mesh.edge_count(); ++e)
    if ((mesh.vertices.col(2)(mesh.edges.row(e)).array() == 1).all())
      mesh.edge_tag[e] = natural_group(0);
  const std::string path = (folder / "cube.msh").string();
  write_msh(path, mesh, {{"top"}});
  const std::string spring = "[[edge]]\ngroup = \"top\"\nspring = \"1e30\"\n";
  const std::string message = refusal([&] { answer(scene(spring, on_file(path), "P1")); });
  EXPECT_NE(message.find("times the area of a face"), std::string::npos) << message;
}

// The parts of a mesh file must lie where the scene needs them, because (22) and (23) are posed on
// a body above a layer of known depth.
TEST(ThreeDimensions, RefuseAFileThatDoesNotFit) {
  const TemporaryFolder folder;
  const auto refused = [&](Mesh mesh, const std::string& effects, const std::string& says) {
    const std::string path = (folder / "mesh.msh").string();
    write_msh(path, mesh);
    const SceneRun run(scene(effects, on_file(path), "P1", "1"));
    expect_no_answer(run, says);
    EXPECT_NE(run.outcome.err.find(": mesh.file: "), std::string::npos) << run.outcome.err;
  };
  const Mesh body = structured_mesh(2, {0, kind}), both = structured_mesh(2, {1, kind});
  const std::string contact = "[contact]\n", layer = "[layer]\nepsilon = 0.1\n";
  Mesh raised = body;
  raised.vertices.col(2).array() += 0.5;
  refused(raised, contact, "accepted: a body above z = 0 with its bottom on that plane");
  refused(raised, layer, "z = 0");
  Mesh lowered = body;
  lowered.vertices.col(2).array() -= 0.5;
  refused(lowered, contact, "accepted: a body on and above z = 0");
  refused(both, contact, "a mesh of the body alone");
  Mesh deep = both;
  for (int v = 0; v < deep.vertex_count(); ++v)
    if (deep.vertices(v, 2) < 0) deep.vertices(v, 2) *= 2;
  refused(deep, layer,
          "accepted for this scene: the slab below the body's bottom, (0, 1) x (0, 1) "
          "x (-1, 0), filled (volume 1)");
  // a depth of 1.05 in place of 1 is wrong by half of a millionth of a large body
  Mesh wide = both;
  wide.vertices.leftCols(2) *= 1e5;
  for (int v = 0; v < wide.vertex_count(); ++v)
    if (wide.vertices(v, 2) < 0) wide.vertices(v, 2) *= 1.05;
  refused(wide, layer, "x (-1, 0), filled");
  Mesh half = both;
  for (int e = 0; e < half.edge_count(); ++e)
    if (half.edge_tag[e] == EdgeTag::contact && half.vertices(half.edges(e, 0), 0) < 0.4)
      half.edge_tag[e] = EdgeTag::clamped;
  refused(half, layer, "accepted: the whole side z = -1");
  Mesh bent = body;
  for (int v = 0; v < bent.vertex_count(); ++v)
    if (bent.vertices.row(v) == Position(Eigen::RowVector3d(0.5, 0.5, 0)))
      bent.vertices(v, 2) = 0.1;
  refused(bent, layer, "has contact faces off the plane z = 0");
}

// The programs beside run_scene know the problem of the paper.
TEST(ThreeDimensions, AreUnknownToTheOtherPrograms) {
  const TemporaryFolder folder;
  const std::string path = (folder / "scene.toml").string();
  std::ofstream(path) << scene(layer_and_contact, made("structured", 2), "P1");
  const std::string table = (folder / "table.csv").string();
  std::ofstream(folder / "u.csv") << "x,y,u\n";
  for (const std::string& arguments :
       {"exact " + in_shell(path) + " </dev/null", "sweep " + in_shell(path) + " --out " + table,
        "estimate " + in_shell(path) + " no.msh " + in_shell(folder / "u.csv")}) {
    const TemporaryFolder log;
    const Outcome outcome = run_antilock(arguments, log);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_NE(outcome.err.find("does not know three dimensions; accepted: "), std::string::npos)
        << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(table));
  }
  for (const std::string option : {"--direct", "--restart"}) {
    const TemporaryFolder log;
    const Outcome outcome =
        run_scene(in_shell(path) + " " + option + " --out " + in_shell(log / "results"), log);
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(log / "results"));
  }
  const TemporaryFolder log;
  EXPECT_EQ(run_scene(in_shell(path) + " --out " + in_shell(log / "results"), log).status, 0);
}

}  // namespace antilock::test::three_dimensions_test
