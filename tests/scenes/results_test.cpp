// What run_scene writes, held to its interface: files, keys, columns, rows, signs, and the numbers
// of the exact solution.
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <utility>

#include "antilock/core/blas.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/exact/exact_solution.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/read_msh.hpp"
#include "antilock/mesh/submesh.hpp"
#include "antilock/space/space.hpp"
#include "scenes/runner.hpp"
#include "support/scenes.hpp"

namespace antilock::test::results_test {

using Keys = std::set<std::string>;

Keys keys(const nlohmann::json& object) {
  Keys names;
  for (const auto& [key, value] : object.items()) names.insert(key);
  return names;
}

Keys files(const std::filesystem::path& folder) {
  Keys names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

std::string scene(const std::string& effects, const std::string& mesh,
                  const std::string& method = "", const std::string& f = "10*sin(2*pi*x)") {
  return "[load]\nf = \"" + f + "\"\n" + effects + "[mesh]\n" + mesh + "\n[method]\n" + method +
         "\n";
}
std::string layer(const std::string& epsilon, const std::string& model = "scaled") {
  return "[layer]\nepsilon = " + epsilon + "\nmodel = \"" + model + "\"\n";
}
std::string structured(int cells) {
  return fmt::format("kind = \"structured\"\ncells = {}", cells);
}
std::string unstructured(int cells) {
  return fmt::format("kind = \"unstructured\"\ncells = {}", cells);
}
const std::string contact = "[contact]\n", cr = "element = \"CR\"\n";

/// contact.csv, and the entries of the summary on contact.
void expect_contact_interface(const nlohmann::json& s, const Csv& table, int dimension) {
  const bool in_space = dimension == 3;
  const Keys in_plane_zone{"points", "active", "from", "to", "from_within", "to_within"};
  const Keys in_space_zone{"points", "active", "from", "to", "y_from", "y_to"};
  const Keys in_plane_force{"normal", "normal_proved", "tangential",
                            "moment", "moment_proved", "unit"};
  const Keys in_space_force{"normal", "moment", "moment_y", "unit"};
  const auto& zone = s["contact"];
  EXPECT_EQ(keys(zone), in_space ? in_space_zone : in_plane_zone);
  EXPECT_EQ(keys(s["contact_force"]), in_space ? in_space_force : in_plane_force);
  const auto model = s["scene"].value("model", nlohmann::json::object());
  const bool rubs = model.contains("friction") || model.contains("coulomb");
  const std::string in_plane = rubs ? "x,gap,pressure,friction" : "x,gap,pressure";
  EXPECT_EQ(table.header, in_space ? "x,y,gap,pressure" : in_plane);
  if (!in_space) {
    EXPECT_EQ(s["contact_force"]["tangential"].is_null(), !rubs);
  }
  ASSERT_EQ(table.rows.rows(), zone["points"].get<Eigen::Index>());
  const Eigen::VectorXd gap = table.rows.col(dimension - 1);
  const Eigen::VectorXd pressure = table.rows.col(dimension);
  EXPECT_GE(gap.minCoeff(), 0.0);
  EXPECT_GE(pressure.minCoeff(), 0.0);
  EXPECT_TRUE(std::is_sorted(table.rows.col(0).begin(), table.rows.col(0).end()));
  const Eigen::Index pressed = (pressure.array() > 0).count();
  const auto active = zone["active"].get<Eigen::Index>();
  EXPECT_LE(pressed, active);
  for (const auto& [name, end] : zone.items()) {
    const bool is_count = name == "points" || name == "active";
    EXPECT_EQ(end.is_null(), !is_count && active == 0) << name;
  }
  if (active == 0 || in_space) return;
  // the ends are ends of their intervals
  EXPECT_EQ(zone["from_within"][1], zone["from"]);
  EXPECT_EQ(zone["to_within"][0], zone["to"]);
  EXPECT_LE(zone["from_within"][0], zone["from"]);
  EXPECT_GE(zone["to_within"][1], zone["to"]);
}

/// Everything that holds for every answer, whatever the scene.
void expect_interface(const std::filesystem::path& results) {
  const auto s = nlohmann::json::parse(contents(results / "summary.json"));
  const auto effects = s["effects"].get<std::vector<std::string>>();
  const bool has_layer = std::count(effects.begin(), effects.end(), "layer") == 1;
  const bool has_contact = std::count(effects.begin(), effects.end(), "contact") == 1;
  EXPECT_EQ(effects.size(), static_cast<std::size_t>(has_layer + has_contact));
  Keys top = {"element", "solver",  "epsilon", "h",         "dofs",       "effects",
              "energy",  "u_max",   "u_min",   "kkt",       "iterations", "blas",
              "seconds", "warning", "scene",   "compliance"};
  Keys written = {"summary.json", "solution.csv", "mesh.msh", "solution.vtu"};
  if (has_layer) top.insert("locking");
  if (has_contact) {
    top.insert("contact");
    top.insert("contact_force");
    written.insert("contact.csv");
  }
  if (s["scene"]["method"].contains("accuracy")) top.insert("certificate");
  if (s["scene"].contains("at")) top.insert("at");
  const bool vector = s["scene"].contains("model");  // plane strain: two components
  if (vector && s["scene"]["model"].contains("coulomb")) top.insert("coulomb");
  EXPECT_EQ(keys(s), top);
  EXPECT_EQ(files(results), written);
  EXPECT_EQ(s["epsilon"].is_null(), !has_layer);
  if (has_layer) {
    EXPECT_EQ(keys(s["locking"]), (Keys{"diagnosis", "kept", "lost_energy"}));
    EXPECT_NE(s["locking"]["diagnosis"], "");
    EXPECT_EQ(s["locking"]["kept"].is_null(), s["locking"]["lost_energy"].is_null());
  }
  EXPECT_EQ(keys(s["iterations"]), (Keys{"contact", "corrections"}));
  EXPECT_EQ(keys(s["blas"]), (Keys{"name", "kernel", "threads"}));
  EXPECT_EQ(keys(s["seconds"]), (Keys{"mesh", "assemble", "factor", "solve", "files", "total"}));
  double stages = 0;
  for (const std::string stage : {"mesh", "assemble", "factor", "solve", "files"}) {
    EXPECT_GE(s["seconds"][stage].get<double>(), 0) << stage;
    stages += s["seconds"][stage].get<double>();
  }
  EXPECT_NEAR(stages, s["seconds"]["total"].get<double>(), 1e-12);
  Keys question = keys(s["scene"]);
  const bool two_bodies = question.contains("contact slave");
  for (const std::string more :
       {"at", "body", "ceiling", "contact master", "contact method", "contact slave", "edge",
        "layer load", "layer stiffness", "layer thickness", "model"})
    question.erase(more);
  EXPECT_EQ(question, (Keys{"title", "load", "layer", "gap", "mesh", "method", "version"}));
  EXPECT_EQ(keys(s["kkt"]), has_contact
                                ? (Keys{"min_gap", "min_pressure", "complementarity", "residual"})
                                : Keys{"residual"});
  EXPECT_LE(s["kkt"]["residual"].get<double>(), 1e-9);

  // one row an unknown, the clamped ones too; the mesh file is the mesh that was used
  ExtraGroups groups;
  const std::string mesh_text = contents(results / "mesh.msh");
  if (mesh_text.find("\"free\"") != mesh_text.npos) groups.curves["free"] = EdgeTag::free;
  for (int k = 0; const auto& edge : s["scene"].value("edge", nlohmann::json::array()))
    groups.curves[edge["group"]] =
        edge.contains("displacement") ? dirichlet_group(k++) : natural_group(k++);
  if (two_bodies) {
    groups.needs_contact = false;
    groups.curves[s["scene"]["contact slave"]] = natural_group(8);
    groups.curves[s["scene"]["contact master"]] = natural_group(9);
  }
  const Mesh mesh = read_msh((results / "mesh.msh").string(), groups);
  const int d = mesh.dimension();
  EXPECT_EQ(d, s["scene"]["mesh"].value("dimension", 2));
  const Space space(mesh, element(s["element"], mesh.kind));
  const Csv solution = read_csv(results / "solution.csv");
  // unknowns that are means have a column of their own beside the values of u
  const bool means = !space.element().nodal();
  std::string header = d == 3 ? "x,y,z,u" : "x,y,u";
  if (means) header = "x,y,u,mean";
  if (vector) header = "x,y,u_x,u_y";
  EXPECT_EQ(solution.header, header);
  ASSERT_EQ(solution.rows.rows(), space.size());
  // positions and values survive the way through text bit by bit (gmsh's own coordinates may be
  // halved once more)
  EXPECT_LE((solution.rows.leftCols(d) - space.dof_coordinates()).cwiseAbs().maxCoeff(), 1e-15);
  const Eigen::MatrixXd values = solution.rows.middleCols(d, vector ? 2 : 1);
  EXPECT_EQ(values.maxCoeff(), s["u_max"].get<double>());
  EXPECT_EQ(values.minCoeff(), s["u_min"].get<double>());
  for (const int i : space.dirichlet_dofs()) EXPECT_EQ(solution.rows(i, means ? 3 : d), 0.0);
  // each constraint of two bodies is an unknown of the systems that are solved
  const int constraints = two_bodies ? s["contact"]["points"].get<int>() : 0;
  EXPECT_EQ(s["dofs"].get<int>(), (vector ? 2 : 1) * space.free_count() + constraints);

  const std::string vtu = contents(results / "solution.vtu");
  const bool jumps = !space.element().conforming();
  const int points = jumps || vector ? (d + 1) * mesh.triangle_count() : mesh.vertex_count();
  EXPECT_NE(vtu.find("NumberOfPoints=\"" + std::to_string(points) + "\""), vtu.npos);
  for (const std::string region : {"body", "layer"})
    EXPECT_EQ(vtu.find("Name=\"" + region + "\"") != vtu.npos, !vector) << region;
  // meshio #1370: it refuses a file with text in it, "Illegal data type 'String'"
  EXPECT_EQ(vtu.find("type=\"String\""), vtu.npos);
  // its arrays stand in the XML: u, the points, connectivity, offsets and types at least
  int arrays = 0;
  for (std::size_t at = 0; (at = vtu.find("format=\"binary\"", at)) != vtu.npos; ++at) ++arrays;
  EXPECT_GE(arrays, 6);
  EXPECT_EQ(vtu.find("format=\"appended\""), vtu.npos);
  const auto& asked = s["scene"]["layer"];
  EXPECT_EQ(vtu.find("Name=\"p\"") != vtu.npos,
            !vector && !asked.is_null() && asked["model"] == "scaled");
  // in plane strain it is the pressure in the block; between two bodies it stands in contact.csv
  // alone
  EXPECT_EQ(vtu.find("Name=\"pressure\"") != vtu.npos, (has_contact && !two_bodies) || vector);

  EXPECT_EQ(keys(s["compliance"]), (Keys{"value", "lower", "upper"}));
  if (!has_contact) {
    EXPECT_EQ(s["iterations"]["contact"].get<int>(), 0);
    return;
  }
  expect_contact_interface(s, read_csv(results / "contact.csv"), d);
  if (!two_bodies) {
    EXPECT_EQ(s["contact"]["points"].get<Eigen::Index>(), std::ssize(space.contact_dofs()));
  }
}

class ExampleScenes : public testing::TestWithParam<std::string> {};

TEST_P(ExampleScenes, RunAndKeepTheInterface) {
  const TemporaryFolder folder;
  const std::string path = std::string(EXAMPLE_SCENES) + "/" + GetParam() + ".toml";
  EXPECT_TRUE(contents(path).starts_with("# ")) << "the first line says what the scene is for";
  const Outcome outcome =
      run_scene(in_shell(path) + " --out " + in_shell(folder / "new/results"), folder);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  expect_interface(folder / "new/results");
}

std::vector<std::string> example_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(EXAMPLE_SCENES))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}
INSTANTIATE_TEST_SUITE_P(All, ExampleScenes, testing::ValuesIn(example_names()),
                         [](const auto& info) { return info.param; });

TEST(ExampleScenes, AreADozenOrMore) { EXPECT_GE(example_names().size(), 12U); }

// Every layer x contact x mesh x element of the family.
class EveryCombination
    : public testing::TestWithParam<std::tuple<int, bool, std::string, std::string>> {};

TEST_P(EveryCombination, RunsAndKeepsTheInterface) {
  const auto [layer_kind, with_contact, mesh, element] = GetParam();
  const std::array<std::string, 5> layers = {"", layer("0.01"), layer("0"), layer("0", "ventcel"),
                                             layer("0.125", "thin")};
  const SceneRun run(scene(layers[layer_kind] + (with_contact ? contact : ""),
                           "kind = \"" + mesh + "\"\ncells = 8",
                           "element = \"" + element + "\"\n"));
  const bool scaled = layer_kind == 1 || layer_kind == 2, ventcel = layer_kind == 3;
  if ((mesh == "layered" && !scaled) || (element == "P2" && ventcel)) {
    EXPECT_EQ(run.outcome.status, 2) << "no such combination";
    EXPECT_NE(run.outcome.err.find("accepted"), std::string::npos) << run.outcome.err;
    return;
  }
  ASSERT_EQ(run.outcome.status, 0) << run.outcome.err;
  expect_interface(run.results);
  const std::string warning = run.summary()["warning"];
  if (scaled && mesh == "unstructured" && element != "CR")
    EXPECT_NE(warning.find(" locks in this layer"), std::string::npos) << warning;
  else
    EXPECT_EQ(warning, "");
}
INSTANTIATE_TEST_SUITE_P(All, EveryCombination,
                         testing::Combine(testing::Range(0, 5), testing::Bool(),
                                          testing::Values("structured", "unstructured", "layered"),
                                          testing::Values("P1", "CR", "P2")));

// The unknowns of hybrid BDM1 are means: the file has the values at the points, too.
TEST(Results, OfAnElementWithMeansHaveValuesAndMeans) {
  const SceneRun run(scene(layer("1e-3") + "[contact]\n", structured(8), "element = \"M2\"\n"));
  const auto summary = run.summary();
  EXPECT_EQ(summary["element"], "BDM1-hybrid");
  const Csv solution = read_csv(run.results / "solution.csv");
  EXPECT_EQ(solution.header, "x,y,u,mean");
  const Space space(read_msh((run.results / "mesh.msh").string()), hybrid_bdm1());
  ASSERT_EQ(solution.rows.rows(), space.size());
  const Eigen::VectorXd means = solution.rows.col(3);
  EXPECT_EQ((values_at_dofs(space, means) - solution.rows.col(2)).cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(solution.rows.col(2).maxCoeff(), summary["u_max"].get<double>());
  const Csv contact = read_csv(run.results / "contact.csv");
  EXPECT_EQ(contact.rows.rows(), 16);
  EXPECT_GE(contact.rows.col(2).minCoeff(), 0);
}

// The resultant is that of the rows of contact.csv: for CR each has the pressure of its edge.
TEST(Results, AddUpTheContactForce) {
  const SceneRun run(scene(layer("1e-3") + contact, structured(16), cr));
  const auto summary = run.summary();
  const Csv table = read_csv(run.results / "contact.csv");
  const Eigen::VectorXd force = table.rows.col(2) / 16;
  const auto& found = summary["contact_force"];
  const double size = force.sum();
  EXPECT_GT(size, 0);
  // pressures below 0 by round-off are 0 in the table: up to 1e-9 of the largest, KKT's tolerance
  EXPECT_NEAR(found["normal"].get<double>(), size, 1e-8 * size);
  EXPECT_NEAR(found["moment"].get<double>(), force.dot(table.rows.col(0)), 1e-8 * size);
  EXPECT_NE(run.outcome.out.find("contact force, upwards"), std::string::npos);
  EXPECT_NE(run.outcome.out.find("compliance L(u)"), std::string::npos);
}

// K is a cone: a(u, u) = L(u) for the discrete solution, too.
TEST(Results, GiveTheComplianceOfALoad) {
  const SceneRun run(scene(layer("1e-3") + contact, unstructured(8), cr));
  const auto summary = run.summary();
  const double energy = summary["energy"];
  // the solve is exact to its tolerance, 1e-10
  EXPECT_NEAR(summary["compliance"]["value"].get<double>(), -2 * energy, 1e-8 * std::abs(energy));
  EXPECT_TRUE(summary["compliance"]["lower"].is_null());
}

TEST(Results, NameTheWholeQuestion) {
  const SceneRun run("title = \"a title\"\n" +
                     scene(layer("1e-3") + "[contact]\ngap = \"0.01*x\"\n", structured(8),
                           cr + "tolerance = 1e-9\n"));
  const auto asked = run.summary()["scene"];
  EXPECT_EQ(asked["title"], "a title");
  EXPECT_EQ(asked["load"], "10*sin(2*pi*x)");
  EXPECT_EQ(asked["layer"], (nlohmann::json{{"epsilon", 1e-3}, {"model", "scaled"}}));
  EXPECT_EQ(asked["gap"], "0.01*x");
  EXPECT_EQ(asked["mesh"], (nlohmann::json{{"kind", "structured"}, {"cells", 8}}));
  EXPECT_EQ(asked["method"],
            (nlohmann::json{{"element", "CR"}, {"solver", "active-set"}, {"tolerance", 1e-9}}));
  EXPECT_TRUE(std::isdigit(asked["version"].get<std::string>().front()));
  const SceneRun from_file(
      scene("", "kind = \"file\"\nfile = \"" + (run.results / "mesh.msh").string() + "\""));
  EXPECT_EQ(from_file.outcome.status, 2);  // it has a layer
  const SceneRun plain(scene("", structured(4)));
  const SceneRun again(
      scene("", "kind = \"file\"\nfile = \"" + (plain.results / "mesh.msh").string() + "\""));
  const auto told = again.summary()["scene"];
  EXPECT_EQ(told["mesh"],
            (nlohmann::json{{"kind", "file"}, {"file", (plain.results / "mesh.msh").string()}}));
  EXPECT_TRUE(told["layer"].is_null() && told["gap"].is_null());
}

/// What summary.json says of the BLAS, in an environment of the program's own.
nlohmann::json blas_used(const std::vector<std::pair<std::string, const char*>>& environment) {
  std::vector<std::pair<std::string, std::optional<std::string>>> before;
  const auto set = [](const std::string& name, const char* value) {
    value ? ::setenv(name.c_str(), value, 1) : ::unsetenv(name.c_str());
  };
  for (const auto& [name, value] : environment) {
    const char* now = std::getenv(name.c_str());
    before.emplace_back(name, now ? std::optional<std::string>(now) : std::nullopt);
    set(name, value);
  }
  const SceneRun run(scene(contact, structured(4)));
  const TemporaryFolder log;  // a program that starts again is the same program
  EXPECT_NE(run_antilock("truth missing.toml", log).err.find("cannot"), std::string::npos);
  for (const auto& [name, value] : before) set(name, value ? value->c_str() : nullptr);
  return run.summary()["blas"];
}

// OpenBLAS takes the kernels that OPENBLAS_CORETYPE names, and any x86-64 executes those of
// Prescott.
TEST(Results, NameTheKernelsInUse) {
  if (blas().kernel.empty()) GTEST_SKIP() << "another BLAS than OpenBLAS";
  const auto used = blas_used({{"OPENBLAS_CORETYPE", "Prescott"}});
  EXPECT_EQ(used["kernel"], "Prescott");
  EXPECT_EQ(used["name"], blas().name);
  EXPECT_GE(used["threads"].get<int>(), 1);
}

TEST(Results, AProgramOfAYoungCpuStartsAgainWithWiderKernelsUnlessToldNotTo) {
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)  // which is preloaded itself
  if (blas().kernel.empty() || !__builtin_cpu_supports("avx"))
    GTEST_SKIP() << "no kernels wider than the oldest";
  const auto used = blas_used({{"LD_PRELOAD", OLD_OPENBLAS},
                               {"OPENBLAS_CORETYPE", nullptr},
                               {"OPENBLAS_NUM_THREADS", nullptr}});
  EXPECT_NE(used["kernel"], "Prescott");
  EXPECT_EQ(used["threads"], 1);
  EXPECT_EQ(blas_used({{"LD_PRELOAD", OLD_OPENBLAS},
                       {"OPENBLAS_CORETYPE", nullptr},
                       {"ANTILOCK_KEEP_KERNELS", "1"}})["kernel"],
            "Prescott");
#else
  GTEST_SKIP() << "known of x86-64 alone, and not under AddressSanitizer";
#endif
}

TEST(Results, SecondsAddUpToTheWallTime) {
  const Stopwatch wall;
  const SceneRun run(scene(layer("1e-3") + contact, unstructured(64), cr));
  const double seconds = wall.seconds(), total = run.summary()["seconds"]["total"];
  EXPECT_LE(total, seconds);
  EXPECT_GE(total, 0.8 * seconds - 0.2)
      << "of " << seconds;  // the process starts and ends outside of it
  EXPECT_GT(run.summary()["seconds"]["files"].get<double>(), 0);
}

TEST(Results, AToleranceIsTakenAtItsWord) {
  const auto corrections = [](const std::string& tolerance) {
    const SceneRun run(
        scene(layer("1e-6") + contact, unstructured(32), "tolerance = " + tolerance + "\n"));
    EXPECT_EQ(run.outcome.status, 0) << run.outcome.err;
    return run.summary()["iterations"]["corrections"].get<int>();
  };
  EXPECT_LT(corrections("1e-4"), corrections("1e-8"));  // not made 1e-8 in silence
}

// A load that lives between the points of the quadrature: u = 0 would be a quiet wrong answer.
TEST(Warnings, ALoadThatTheQuadratureMissesIsFound) {
  for (const std::string f :
       {"1e6*exp(-1e8*(x - 0.4567)^2)", "abs(x - 0.4567) < 1e-4 ? 1e4 : 0",
        "1e4*exp(-1e5*((x - 0.31)^2 + (y - 0.47)^2))", "1 + (abs(y - 0.4567) < 1e-4 ? 1e4 : 0)"}) {
    const SceneRun run(scene(layer("1e-3") + contact, structured(8), cr, f));
    EXPECT_NE(run.summary()["warning"].get<std::string>().find("load.f"), std::string::npos) << f;
    EXPECT_NE(run.outcome.out.find("warning: load.f"), std::string::npos) << f;
  }
  for (const std::string f :
       {"0", "1", "10*sin(2*pi*x)", "10*sin(2*pi*x)*exp(y)", "x < 0.3 ? 20 : -20"}) {
    const SceneRun run(scene(layer("1e-3") + contact, structured(8), cr, f));
    EXPECT_EQ(run.summary()["warning"], "") << f;
  }
}

// Three discs of force between the points of the rule, in balance: no force, no moment, u = 0 by
// the quadrature and -7 in truth. And a wave that turns four times in a cell.
TEST(Warnings, ALoadWithoutForceOrMomentIsFoundBetweenThePoints) {
  const auto disc = [](int weight, double x, double y) {
    return fmt::format("{}*((x - {})^2 + (y - {})^2 < 0.003 ? 1000 : 0)", weight, x, y);
  };
  const std::string discs = disc(1, 0.6705427, 0.9223774) + " + " + disc(-2, 0.4164415, 0.6715546) +
                            " + " + disc(1, 0.1623403, 0.4207318);
  for (const auto& [f, cells] :
       {std::pair(discs, 4), std::pair(std::string("100*sin(64*pi*x)"), 8)}) {
    const SceneRun run(scene(layer("1e-3"), structured(cells), "", f));
    EXPECT_NE(run.summary()["warning"].get<std::string>().find("between its points"),
              std::string::npos)
        << f;
  }
}

// s / t^2 = 1, s = 1e-6: CR's u is 13 times the largest one of P2. The maximum principle tells.
TEST(Warnings, ALayerSoSoftAlongXThatCrouzeixRaviartIsWrongInItIsNamed) {
  for (const auto& [method, wrong] :
       {std::pair(cr, true), {std::string("element = \"P2\""), false}}) {
    const SceneRun run(
        scene("[layer]\nthickness = 1e-3\nstiffness = 1e-3\nload = \"0\"\n" + contact,
              unstructured(32), method));
    EXPECT_EQ(run.summary()["warning"].get<std::string>().find("beyond the values around it") !=
                  std::string::npos,
              wrong);
  }
}

/// The share of the energy that the layer's motion releases which P1 loses on an unstructured mesh,
/// by two more solves: on the same body with a layer in columns, and at epsilon = 0, where P1 holds
/// the layer still. 31 % by gmsh 4.8.
double lost_by_p1(int cells, double epsilon) {
  const TriangleMesh mesh = unstructured_mesh(cells),
                     columns = extruded(body_submesh(mesh), epsilon);
  const auto energy_on = [](const TriangleMesh& on, double eps) {
    const Space space(on, p1());
    const VariationalInequality problem = assemble(stiff_scene(eps), space);
    return energy(problem, active_set(problem));
  };
  const double best = energy_on(columns, epsilon);
  return (energy_on(mesh, epsilon) - best) / (energy_on(mesh, 0) - best);
}

// Figure 7 says of itself what Figure 8 shows, on the terminal and in the summary, with the
// remedies; they are some.
TEST(Warnings, ALayerThatLocksIsNamedWithWhatIsLost) {
  const auto asked = [](const std::string& epsilon, const std::string& kind,
                        const std::string& method) -> SceneRun {
    return SceneRun(scene(layer(epsilon) + contact, "kind = \"" + kind + "\"\ncells = 32", method));
  };
  const double lost = lost_by_p1(32, 1e-2);
  EXPECT_GT(lost, 0.1);
  for (const std::string solver : {"active-set", "uzawa"}) {
    const SceneRun run =
        asked("1e-2", "unstructured", "solver = \"" + solver + "\"\ntolerance = 1e-6");
    const auto s = run.summary();
    const double told = s["locking"]["lost_energy"];
    EXPECT_NE(s["warning"].get<std::string>().find(fmt::format(
                  "P1 locks in this layer: it loses at least {:.0f} %", std::floor(100 * told))),
              std::string::npos);
    EXPECT_NE(run.outcome.out.find("  warning: P1 locks"), std::string::npos) << run.outcome.out;
    // what a layer constant in y does not reach: (2 pi epsilon)^2 / 3 for one wave, four times that
    // for two
    EXPECT_NEAR(told, lost, 5e-3);
    EXPECT_EQ(s["locking"]["kept"].get<double>() + told, 1);
  }
  for (const auto& [epsilon, kind, method] :
       std::vector<std::array<std::string, 3>>{{"1e-2", "unstructured", cr},
                                               {"1e-2", "layered", ""},
                                               {"1e-2", "structured", ""},
                                               {"0.3", "unstructured", ""}})
    EXPECT_EQ(asked(epsilon, kind, method).summary()["warning"], "") << epsilon << kind << method;
}

TEST(Warnings, AnObstacleBetweenTheContactUnknownsIsFound) {
  for (const std::string& mesh : {structured(8), unstructured(8)})
    for (const std::string bound : {"gap = \"0.01", "gap = \"1\"\nceiling = \"0.01"}) {
      const SceneRun run(scene(
          layer("1e-3") + "[contact]\n" + bound + " - exp(-1e8*(x - 0.4567)^2)\"\n", mesh, cr));
      EXPECT_NE(run.summary()["warning"].get<std::string>().find("misses the obstacle"),
                std::string::npos)
          << bound;
    }
  for (const std::string element : {"P1", "CR", "P2"}) {
    const SceneRun run(
        scene(layer("0.05") + "[contact]\ngap = \"0.02 - 0.1*exp(-50*(x - 0.5)^2)\"\n",
              structured(32), "element = \"" + element + "\"\n", "1"));
    EXPECT_EQ(run.summary()["warning"], "") << element;
  }
}

TEST(Results, TheContactForceBalancesTheExactOne) {
  // CR, 1/h = 64: the pressure is a density, so its sum over cells of length h is the whole force;
  // the exact pressure integrates to it up to the O(h) of the two ends of the contact zone.
  const SceneRun run(scene(layer("1e-2") + contact, structured(64), cr));
  ASSERT_EQ(run.outcome.status, 0) << run.outcome.err;
  const Csv table = read_csv(run.results / "contact.csv");
  const ExactSolution exact_solution(paper_sine_load(), 1e-2);
  double exact = 0;
  constexpr int n = 4096;
  for (int i = 0; i < n; ++i) exact += exact_solution.pressure((i + 0.5) / n) / n;
  EXPECT_NEAR(table.rows.col(2).sum() / 64, exact, 0.02 * exact);
  EXPECT_NEAR(run.summary()["contact"]["from"].get<double>(), 0.69753, 1.5 / 64);
  EXPECT_NEAR(run.summary()["energy"].get<double>(), -0.44157558,
              3e-4);  // 1.8e-4 off at 1/h = 64, falling like h^2
}

TEST(Results, AnObstacleThatPressesInIsObeyed) {
  const SceneRun run(
      scene(layer("0.05") + "[contact]\ngap = \"-0.05*sin(pi*x)\"\n", structured(32), "", "0"));
  EXPECT_NEAR(run.summary()["u_max"].get<double>(), 0.05, 1e-3);
}

TEST(Results, AnObstacleFarAwayInOnePlaceHidesNoContactInAnother) {
  double near_energy = 0;
  for (const std::string solver : {"active-set", "uzawa"})
    for (const std::string far : {"1", "1e6", "1e14", "1e90"}) {
      const SceneRun run(scene(layer("0.1") + "[contact]\ngap = \"x < 0.75 ? " + far + " : 0\"\n",
                               structured(16), "solver = \"" + solver + "\"\n"));
      EXPECT_EQ(run.summary()["contact"]["from"].get<double>(), 0.75) << solver << " " << far;
      EXPECT_EQ(run.summary()["solver"], solver);
      EXPECT_EQ(run.summary()["iterations"]["contact"].get<int>() > 10, solver == "uzawa");
      const double energy = run.summary()["energy"].get<double>();
      if (near_energy == 0) near_energy = energy;
      EXPECT_NEAR(energy, near_energy, 1e-9) << solver << " " << far;  // solved to 1e-10
    }
}

TEST(Results, AreThoseThatAreAskedForAndThoseOfAnEarlierRunGo) {
  const SceneRun whole(scene(layer("1e-3") + contact, structured(4)));
  const auto again = [&](const std::string& files) {
    return run_scene(in_shell(whole.scene_path) + " --out " + in_shell(whole.results.string()) +
                         " --files " + files,
                     whole.output);
  };
  // those of an earlier run on several ranks are no picture of this one
  for (const std::string name :
       {"solution.pvtu", "solution_0.vtu", "solution_1.vtu", "other_0.vtu"})
    std::ofstream(whole.results / name) << "earlier";
  const Outcome refused = again("csv,pdf");
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(
      refused.err,
      "--files: \"pdf\" is none of the files; accepted: summary, csv, mesh, vtu, with commas\n");
  EXPECT_EQ(files(whole.results).size(), 9U);
  EXPECT_EQ(again("mesh,csv").status, 0);
  EXPECT_EQ(files(whole.results),
            (Keys{"summary.json", "solution.csv", "contact.csv", "mesh.msh", "other_0.vtu"}));
  EXPECT_EQ(again("summary").status, 0);
  EXPECT_EQ(files(whole.results), (Keys{"summary.json", "other_0.vtu"}));
  for (const std::string name : {"solution.pvtu", "solution_0.vtu"})
    std::ofstream(whole.results / name) << "earlier";
  EXPECT_EQ(again("vtu").status, 0);
  EXPECT_EQ(files(whole.results), (Keys{"summary.json", "solution.vtu", "other_0.vtu"}));
}

TEST(Results, OfAnEarlierSceneAreReplacedAndTheTableOfAnAbsentContactGoes) {
  const TemporaryFolder folder;
  std::ofstream(folder / "with.toml") << scene(contact, structured(8));
  std::ofstream(folder / "without.toml") << scene("", structured(8));
  for (const std::string name : {"with", "without"})
    ASSERT_EQ(
        run_scene(in_shell(folder / (name + ".toml")) + " --out " + in_shell(folder / "results"),
                  folder)
            .status,
        0);
  expect_interface(folder / "results");
}

TEST(Results, OfAFailedRunLeaveEarlierOnesAlone) {
  const TemporaryFolder folder;
  std::ofstream(folder / "good.toml") << scene(contact, structured(8));
  std::ofstream(folder / "bad.toml") << scene(contact, structured(0));
  const std::string out = " --out " + in_shell(folder / "results");
  ASSERT_EQ(run_scene(in_shell(folder / "good.toml") + out, folder).status, 0);
  const std::string before = contents(folder / "results/solution.csv");
  ASSERT_EQ(run_scene(in_shell(folder / "bad.toml") + out, folder).status, 2);
  EXPECT_EQ(contents(folder / "results/solution.csv"), before);
  expect_interface(folder / "results");
}

TEST(Results, GoToAFolderNamedAfterTheSceneWhereNoneIsGiven) {
  const TemporaryFolder folder;
  std::ofstream(folder / "mine.toml") << scene("", structured(4));
  const std::string command = "cd " + in_shell(folder.path().string()) + " && " +
                              in_shell(RUN_SCENE) + " mine.toml >/dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  expect_interface(folder / "results/mine");
}

// A scene is run in the folder that it came in. A link in it may lead to results of another scene.
TEST(Results, GoThroughNoLinkThatNobodyNamed) {
  for (const std::string link : {"results", "results/mine"}) {
    const TemporaryFolder folder, elsewhere;
    std::ofstream(folder / "mine.toml") << scene("", structured(4));
    std::filesystem::create_directories(std::filesystem::path(elsewhere / "mine"));
    for (const std::string place : {"mine/solution.pvtu", "solution.pvtu"})
      std::ofstream(elsewhere / place) << "another run";  // which a run would remove
    if (link != "results") std::filesystem::create_directory(folder / "results");
    std::filesystem::create_directory_symlink(elsewhere.path(), folder / link);
    const std::string command = "cd " + in_shell(folder.path().string()) + " && " +
                                in_shell(RUN_SCENE) + " mine.toml >/dev/null 2>err";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2) << link;
    EXPECT_NE(contents(folder / "err").find(link + " is a link"), std::string::npos)
        << contents(folder / "err");
    EXPECT_EQ(contents(elsewhere / "solution.pvtu"), "another run");
    EXPECT_EQ(contents(elsewhere / "mine/solution.pvtu"), "another run");
    EXPECT_FALSE(std::filesystem::exists(elsewhere / "summary.json"));
    EXPECT_FALSE(std::filesystem::exists(elsewhere / "mine/summary.json"));
  }
}

TEST(Results, TheMeshOfARunServesAsAMeshFile) {
  const SceneRun first(scene(layer("1e-3") + contact, unstructured(8), cr));
  const SceneRun second(
      scene(layer("1e-3") + contact,
            "kind = \"file\"\nfile = \"" + (first.results / "mesh.msh").string() + "\"", cr));
  // the same mesh, numbered the same way; gmsh's columns, off by 4e-13 at most, are made vertical
  // where a file is read
  EXPECT_NEAR(second.summary()["energy"].get<double>(), first.summary()["energy"].get<double>(),
              1e-11);
}

TEST(Unreachable, ToleranceIsSaidInOneLineAndNothingIsWritten) {
  using Question = std::pair<std::string, std::string>;
  const std::string far = "tolerance = 1e-30\n";
  for (const auto& [effects, method] :
       {Question{"", far},
        {layer("1e-6"), far},
        {layer("0") + contact, far},
        {layer("0", "ventcel") + contact, far},
        {layer("1e-3") + contact, "solver = \"uzawa\"\ntolerance = 1e-16\n"}}) {
    const SceneRun run(scene(effects, structured(8), method));
    expect_no_answer(run, run.scene_path + ": solve: ", 3);
    EXPECT_TRUE(run.outcome.err.starts_with(run.scene_path + ": solve: "));
  }
}

TEST(Unreachable, TimeLimitEndsTheSolveAndSaysHowFarItCame) {
  const TemporaryFolder folder;
  std::ofstream(folder / "scene.toml") << scene(layer("1e-6") + contact, structured(16));
  const Outcome outcome = run_scene(
      in_shell(folder / "scene.toml") + " --most-seconds 0 --out " + in_shell(folder / "results"),
      folder);
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("stopped as asked after 1 steps"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "results"));
}

TEST(Help, TellsANewcomerEverySectionAndFile) {
  const TemporaryFolder log;
  const Outcome outcome = run_scene("--help", log);
  EXPECT_EQ(outcome.status, 0);
  for (const std::string word : {"[load]", "[layer]", "[contact]", "[mesh]", "[method]",
                                 "summary.json", "solution.csv", "--out"})
    EXPECT_NE(outcome.out.find(word), outcome.out.npos) << word;
}

}  // namespace antilock::test::results_test
