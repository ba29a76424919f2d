// Inputs at the edge of what a scene, a matrix or a command line may be. Each was made here after a
// public report on another program, which is named beside it (tests/README.md lists them): it is
// answered right, or refused in one line that says where, and never takes part of what is meant in
// silence.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scenes/runner.hpp"
#include "support/scenes.hpp"

namespace antilock::test::unusual_inputs_test {

std::string scene(const std::string& sections, const std::string& f = "10*sin(2*pi*x)",
                  int cells = 8) {
  return fmt::format("{}\n[load]\nf = \"{}\"\n[mesh]\nkind = \"structured\"\ncells = {}\n",
                     sections, f, cells);
}
std::string effects(const std::string& more) { return scene("[contact]\n" + more); }

// Kratos #5568 and jkitchin/pounce #386 are on absolute tolerances in contact: below a size every
// answer passes.
TEST(Load, ScalesTheAnswerOverAllOfDoublePrecision) {
  const auto of = [](const std::string& factor) {
    return SceneRun(scene("[layer]\nepsilon = 1e-3\n[contact]", factor + "*sin(2*pi*x)")).summary();
  };
  const nlohmann::json one = of("1");
  for (const char* factor : {"1e-100", "1e-200", "1e-300", "1e90"}) {
    const nlohmann::json scaled = of(factor);
    EXPECT_EQ(scaled["contact"], one["contact"]) << factor;
    // u is linear in the load where the obstacle is at distance 0; 1e-12 is ten times what was seen
    EXPECT_NEAR(double(scaled["u_max"]) / std::stod(factor), one["u_max"], 1e-12) << factor;
  }
}

// awslabs/palace #941 and trilinos #14070: a residual divided by that of the start, which is 0.
TEST(Load, OfZeroHasTheAnswerZeroForEverySolverAndAccuracy) {
  for (const char* method :
       {"solver = \"uzawa\"", "solver = \"active-set\"", "accuracy = 0.1", "element = \"P2\""}) {
    const SceneRun run(scene("[layer]\nepsilon = 1e-3\n[contact]", "0") + "[method]\n" + method +
                       "\n");
    const nlohmann::json summary = run.summary();
    EXPECT_EQ(summary["u_max"], 0.0) << method;
    EXPECT_EQ(summary["energy"], 0.0) << method;
    if (summary.contains("certificate")) {
      EXPECT_EQ(summary["certificate"]["relative"], 0.0);
    }
  }
}

// dzhang314/MultiFloats.jl #80: division by subnormals. epsilon^2 is 0 in double precision, and so
// is the rigid limit.
TEST(Layer, AsThinAsTheSmallestDoubleIsRigid) {
  const auto at = [](const std::string& epsilon) {
    return double(SceneRun(scene("[contact]\n[layer]\nepsilon = " + epsilon)).summary()["u_max"]);
  };
  for (const char* epsilon : {"1e-160", "1e-320", "5e-324"})
    EXPECT_DOUBLE_EQ(at(epsilon), at("0")) << epsilon;
}

// The same: the product of stiffness and thickness is 0. The obstacle, absent here, was named as
// the reason.
TEST(Layer, WhoseStiffnessIsLostNamesTheStiffness) {
  expect_no_answer(SceneRun(scene("[layer]\nthickness = 1e-10\nstiffness = 1e-320")),
                   "layer.stiffness: ");
}

// The same: a layer of next to no stiffness was answered with conditions that "hold only to
// 1.0e+00", and the number before the second form of a right one was printed as "inf".
TEST(Layer, OfNextToNoStiffnessIsRefusedAndAnEnormousOneIsTold) {
  expect_no_answer(SceneRun(scene("[layer]\nthickness = 1e-200\nstiffness = 1")),
                   "at most 1e16 times the softest", 2);
  const SceneRun told(scene("[layer]\nthickness = 1e-160\nstiffness = 1e160"));
  EXPECT_EQ(told.outcome.status, 0) << told.outcome.err;
  EXPECT_NE(told.outcome.out.find("layer: 1 before a_x^-, 1 / 1e-160^2 before a_y^-"),
            std::string::npos)
      << told.outcome.out;
}

// jkcshea/ivmte #225 and osqp #109: a lower bound above the upper one is found late, and by its
// number.
TEST(Ceiling, BelowTheObstacleIsRefusedWithItsPlace) {
  const std::string obstacle = "gap = \"-0.1*sin(pi*x)\"\nceiling = ";
  expect_no_answer(
      SceneRun(effects(obstacle + "\"0.05*sin(pi*x)\"")),
      "contact.ceiling: contact: ceiling(0.001) = 0.000157079 is below the obstacle, -gap(0.001) = "
      "0.000314159; accepted: ceiling >= -gap");
  expect_no_answer(SceneRun(effects("ceiling = \"x < 0.5 ? 0.1 : x < 0.6 ? -0.01 : 0.1\"")),
                   "is below the obstacle");
}

// Where both are the same formula written twice, the last digit of one decides nothing.
TEST(Ceiling, OnTheObstacleHoldsTheBody) {
  const SceneRun run(effects("gap = \"-sin(pi*x)/3\"\nceiling = \"sin(pi*x)*(1/3)\""));
  ASSERT_EQ(run.outcome.status, 0) << run.outcome.err;
  const Csv contact = read_csv(run.results / "contact.csv");
  EXPECT_EQ(contact.rows.rows(), 7);
  EXPECT_LE(contact.rows.col(1).cwiseAbs().maxCoeff(), 1e-15);
}

// idaholab/moose #29777 and luchete80/WeldForm #175 are on contact that begins penetrated.
TEST(Obstacle, InsideTheBodyLiftsItWhateverTheLoad) {
  for (const char* f : {"0", "-10", "1e-30"}) {
    const SceneRun run(scene("[contact]\ngap = \"-0.1*sin(pi*x)\"", f, 16));
    ASSERT_EQ(run.outcome.status, 0) << run.outcome.err;
    EXPECT_DOUBLE_EQ(run.summary()["u_max"], 0.1) << f;
    EXPECT_GE(read_csv(run.results / "contact.csv").rows.col(2).minCoeff(), 0) << f;
  }
}

// toml-rs/toml-rs #252 and leaperone/smctl #9 are on values whose type is read in silence as
// another. A program that writes TOML writes a list of no sections as [].
TEST(Toml, TakesAnEmptyListOfEdgesAndNoPartOfANumber) {
  EXPECT_EQ(SceneRun(scene("edge = []")).outcome.status, 0);
  expect_no_answer(SceneRun(scene("") + "[method]\naccuracy = 0.5\nmost_unknowns = 1000.5\n"),
                   "method.most_unknowns: 1000.5 is out of range");
  expect_no_answer(SceneRun(scene("title = 1979-05-27")), "title: is of type date");
  expect_no_answer(SceneRun(scene("[at]\npoints = [[true, 0.5]]")),
                   "at.points: has an entry that is no place");
  expect_no_answer(SceneRun(scene("[at]\npoints = [[9007199254740993, 0]]")), "at.points: ");
}

// facebook/openzl #225: a text of several lines.
TEST(Toml, FormulasMayHaveSeveralLines) {
  const auto with = [](const std::string& f, const std::string& gap) {
    return SceneRun(fmt::format(
        "[load]\nf = {}\n[contact]\ngap = {}\n[mesh]\nkind = \"structured\"\ncells = 8\n", f, gap));
  };
  const nlohmann::json lines =
      with("\"\"\"\n  10*sin(\r\n\t2*pi*x)\n\"\"\"", "'''0\n+\n0.01'''").summary();
  const nlohmann::json line = with("\"10*sin(2*pi*x)\"", "\"0 + 0.01\"").summary();
  EXPECT_EQ(lines["energy"], line["energy"]);
  EXPECT_LT(double(line["energy"]), 0);
  expect_no_answer(with("\"\"\"1 +\n 2 x\"\"\"", "\"0\""), "\"x\" is not expected at position 8");
  expect_no_answer(with("\"\"\"\n \n\"\"\"", "\"0\""), "is empty");
}

// p-ranav/argparse #369: an option without its value keeps its default.
// `--files "$unset"` lost all but the summary.
TEST(CommandLine, WithAnEmptyListOfFilesIsRefused) {
  const TemporaryFolder folder;
  std::ofstream(folder / "scene.toml") << scene("");
  const Outcome refused = run_scene(
      in_shell(folder / "scene.toml") + " --files '' --out " + in_shell(folder / "out"), folder);
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.err,
            "--files: names no file; accepted: summary, csv, mesh, vtu, with commas\n");
}

// crystal-lang/crystal #6359 and #14569, circus-tent/circus #417: standard streams that are closed.
// A refusal ended by SIGABRT, since the line that explains it could not be written.
TEST(CommandLine, EndsWithItsStatusWhereStandardErrorTakesNothing) {
  const TemporaryFolder folder;
  std::ofstream(folder / "bad.toml") << "nothing\n";
  for (const char* where : {"2>&-", "2>/dev/full", "<&- >&- 2>&-"}) {
    EXPECT_EQ(run_scene(in_shell(folder / "bad.toml") + " " + where, folder).status, 2) << where;
    EXPECT_EQ(run_scene(std::string("--no-such-option ") + where, folder).status, 2) << where;
    EXPECT_EQ(run_antilock(std::string("nothing ") + where, folder).status, 2) << where;
    EXPECT_EQ(run_antilock(std::string("truth ") + where, folder).status, 2) << where;
  }
}

// crystal-lang/crystal #17271: the first file that is opened gets the number of a closed standard
// output.
TEST(CommandLine, WithClosedStreamsWritesWholeResults) {
  const TemporaryFolder folder;
  std::ofstream(folder / "scene.toml") << scene("[contact]");
  const std::string out = folder / "out";
  // in a shell of its own, which has the streams that are closed for the program
  const std::string ask = fmt::format("{} {} --out {} <&- >&- 2>&-", in_shell(RUN_SCENE),
                                      in_shell(folder / "scene.toml"), in_shell(out));
  std::system(ask.c_str());  // where its words do not arrive, its status is no concern of this test
  if (!std::filesystem::exists(out)) return;  // nothing is written, then
  EXPECT_TRUE(nlohmann::json::accept(contents(out + "/summary.json")));
  EXPECT_EQ(read_csv(out + "/solution.csv").header, "x,y,u");
  EXPECT_TRUE(contents(out + "/mesh.msh").starts_with("$MeshFormat"));
}

// JuliaPackaging/BinaryBuilder.jl #740: a link in the place of a folder. It was found after the
// solve.
TEST(Results, IntoALinkToNothingAreRefusedBeforeTheWork) {
  const TemporaryFolder folder;
  std::ofstream(folder / "scene.toml") << scene("");
  std::filesystem::create_symlink("nowhere", folder / "link");
  const Outcome refused =
      run_scene(in_shell(folder / "scene.toml") + " --out " + in_shell(folder / "link"), folder);
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.out, "");
  EXPECT_NE(refused.err.find("is a link to nothing; accepted: a folder that can be made"),
            refused.err.npos)
      << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "nowhere"));
}

// The same: a folder in the place of a result, of one that is written or of one of an earlier run,
// was found after the solve.
TEST(Results, InThePlaceOfAFolderAreRefusedBeforeTheWork) {
  for (const std::string name : {"solution.vtu", "summary.json", "solution.pvtu"}) {
    const TemporaryFolder folder;
    std::ofstream(folder / "scene.toml") << scene("");
    std::filesystem::create_directories(std::filesystem::path(folder / "results") / name /
                                        "inside");
    const Outcome refused = run_scene(
        in_shell(folder / "scene.toml") + " --files summary --out " + in_shell(folder / "results"),
        folder);
    EXPECT_EQ(refused.status, 2) << name;
    EXPECT_EQ(refused.out, "") << name;
    EXPECT_NE(refused.err.find(name + " is a folder, where the result " + name + " is to stand"),
              refused.err.npos)
        << refused.err;
    EXPECT_TRUE(
        std::filesystem::exists(std::filesystem::path(folder / "results") / name / "inside"));
  }
}

// firelab/windninja #382: two runs into one folder. Both have answers of different sizes, one has
// contact.
TEST(Results, OfTwoRunsAtOnceAreThoseOfOneOfThem) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.toml") << scene("[contact]");
  std::ofstream(folder / "b.toml") << scene("", "1", 5);
  const std::string out = folder / "out";
  const auto start = [&](const char* name) {
    return fmt::format("{} {} --out {} >{} 2>&1", in_shell(RUN_SCENE), in_shell(folder / name),
                       in_shell(out), "/dev/null");
  };
  const std::string both =
      fmt::format("for i in 1 2 3 4; do {} & {} & done; wait", start("a.toml"), start("b.toml"));
  ASSERT_EQ(std::system(both.c_str()), 0);
  const nlohmann::json summary = nlohmann::json::parse(contents(out + "/summary.json"));
  const bool contact = summary.contains("contact");
  EXPECT_EQ(read_csv(out + "/solution.csv").rows.rows(), contact ? 81 : 36);
  EXPECT_EQ(std::filesystem::exists(out + "/contact.csv"), contact);
}

// PixarAnimationStudios/OpenUSD #1604 and google/renameio #33: files made elsewhere and renamed
// have other permissions.
TEST(Results, HaveThePermissionsThatTheUmaskLeaves) {
  using std::filesystem::perms;
  const TemporaryFolder folder;
  std::ofstream(folder / "scene.toml") << scene("");
  const std::string out = folder / "out";
  const std::string ask = fmt::format("umask 027; {} {} --out {} >/dev/null", in_shell(RUN_SCENE),
                                      in_shell(folder / "scene.toml"), in_shell(out));
  ASSERT_EQ(std::system(ask.c_str()), 0);
  EXPECT_EQ(std::filesystem::status(out).permissions(), perms(0750));
  EXPECT_EQ(std::filesystem::status(out + "/solution.csv").permissions(), perms(0640));
}

// Ferrite #1181, sfepy #285 and KVSlab/VaSP #138: points on edges, on corners and between
// subdomains are found nowhere.
TEST(Points, OnCornersEdgesAndSigmaHaveTheValueOfTheirVertex) {
  const SceneRun run(
      scene("[layer]\nepsilon = 0.1\n[contact]\n[at]\npoints = [[0, 0], [1, 1], [1, -1], [0.5, 0], "
            "[0.25, 0.25], [0.0625, 0.0625], [0.5, -1], [0.5, 1]]"));
  const nlohmann::json at = run.summary()["at"];
  const Csv solution = read_csv(run.results / "solution.csv");
  ASSERT_EQ(at.size(), 8U);
  for (const nlohmann::json& point : at) {
    const double x = point["x"], y = point["y"];
    for (Eigen::Index i = 0; i < solution.rows.rows(); ++i)
      if (solution.rows(i, 0) == x && solution.rows(i, 1) == y) {
        EXPECT_NEAR(point["u"], solution.rows(i, 2), 1e-15);
      }
  }
  EXPECT_EQ(at[0]["u"], 0.0);
}

// vietjtnguyen/argagg #10: a table over one cell, all of whose unknowns are held, was refused by
// the number of an unknown.
TEST(Sweep, OverAMeshWithoutUnknownsNamesTheMesh) {
  const TemporaryFolder folder;
  std::ofstream(folder / "scene.toml") << scene("[layer]\nepsilon = 1e-3\n[contact]");
  const Outcome refused =
      run_antilock("sweep " + in_shell(folder / "scene.toml") + " --cells 4,1", folder);
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("mesh: with 1 cells every unknown is clamped"), refused.err.npos)
      << refused.err;
}

// facebook/zstd #1459, rspeer/python-ftfy #78 and rasterio #539: an output that is an input. The
// scene, or the answer that had taken hours, was replaced.
TEST(CommandLine, WhoseOutputIsAnInputIsRefusedAndTheInputStays) {
  const TemporaryFolder folder;
  const std::string text = scene("[layer]\nepsilon = 1e-3\n[contact]"),
                    file = in_shell(folder / "scene.toml");
  std::ofstream(folder / "scene.toml") << text;
  std::filesystem::create_hard_link(folder / "scene.toml", folder / "same.toml");
  std::ofstream(folder / "points.csv") << "x,y\n0.5,-1\n";
  ASSERT_EQ(run_scene(file + " --out " + in_shell(folder / "results"), folder).status, 0);
  const std::string answer = folder / "results/solution.csv", before = contents(answer);
  const std::string judge =
      fmt::format("judge {} {} {}", file, in_shell(folder / "results/mesh.msh"), in_shell(answer));
  for (const std::string& ask :
       {"sweep " + file + " --epsilon 0.1 --out " + file,
        "sweep " + file + " --out " + in_shell(folder / "same.toml"),
        "truth " + file + " --summary " + file + " <" + in_shell(folder / "points.csv"),
        judge + " --json " + in_shell(answer), judge + " --where " + file}) {
    const Outcome refused = run_antilock(ask, folder);
    EXPECT_EQ(refused.status, 2) << ask;
    EXPECT_NE(refused.err.find("which is read; accepted: another file\n"), refused.err.npos)
        << refused.err;
    EXPECT_EQ(refused.out, "") << ask;
  }
  EXPECT_EQ(contents(folder / "scene.toml"), text);
  EXPECT_EQ(contents(answer), before);
}

class MatrixMarket : public ::testing::Test {
 protected:
  /// A1 = [2 -1; -1 2] as it is written, with B = (1 -1), M = (1) and the load (1, 1).
  Outcome asked(const std::string& a1) {
    const auto write = [&](const char* name, const std::string& text) {
      std::ofstream(folder / name) << "%%MatrixMarket matrix coordinate real " << text;
    };
    write("A1.mtx", a1);
    write("B.mtx", "general\n1 2 2\n1 1 1\n1 2 -1\n");
    write("M.mtx", "general\n1 1 1\n1 1 1\n");
    write("L.mtx", "general\n2 1 2\n1 1 1\n2 1 1\n");
    std::string files = "lockcheck";
    for (const char* name : {"A1.mtx", "B.mtx", "M.mtx", "L.mtx"})
      files += " " + in_shell(folder / name);
    return run_antilock(files, folder);
  }
  TemporaryFolder folder;
};

// alugowski/fast_matrix_market #49, JuliaSparse/MatrixMarket.jl #35: a symmetric matrix of which
// both triangles are written. Each entry off the diagonal was doubled.
TEST_F(MatrixMarket, OfOneTriangleIsTheWholeMatrixAndOfBothIsRefused) {
  const std::string whole = asked("general\n2 2 4\n1 1 2\n2 2 2\n1 2 -1\n2 1 -1\n").out;
  ASSERT_NE(whole, "");
  for (const char* triangle : {"2 1 -1", "1 2 -1"})
    EXPECT_EQ(asked(fmt::format("symmetric\n2 2 3\n1 1 2\n2 2 2\n{}\n", triangle)).out, whole)
        << triangle;
  const Outcome both = asked("symmetric\n2 2 4\n1 1 2\n2 2 2\n1 2 -1\n2 1 -1\n");
  EXPECT_EQ(both.status, 2);
  EXPECT_NE(both.err.find("line 6: symmetric, and with entries above the diagonal and below"),
            both.err.npos)
      << both.err;
}

// The imaginary parts of a complex matrix under the header of a real one were left out.
TEST_F(MatrixMarket, WithMoreThanAnEntryOnALineIsRefused) {
  const Outcome more = asked("general\n2 2 2\n1 1 2 0.5\n2 2 2 0.5\n");
  EXPECT_EQ(more.status, 2);
  EXPECT_NE(more.err.find("line 3: \"0.5\" behind the entry; accepted: ROW COLUMN VALUE"),
            more.err.npos)
      << more.err;
}

}  // namespace antilock::test::unusual_inputs_test
