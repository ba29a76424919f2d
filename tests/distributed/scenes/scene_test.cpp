// run_scene with solver = "petsc", from outside: alone and under mpiexec, asked well and badly,
// ended and restarted.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/layered.hpp"
#include "antilock/mesh/write_msh.hpp"
#include "scenes/runner.hpp"
#include "support/bodies.hpp"

namespace antilock::test {
namespace {

namespace fs = std::filesystem;

std::string scene_text(const std::string& solver, const std::string& kind,
                       const std::string& element, int cells, const std::string& method = "",
                       int refinements = 0) {
  return "[load]\nf = \"10*sin(2*pi*x)\"\n[layer]\nepsilon = 1e-6\n[contact]\n[mesh]\nkind = \"" +
         kind + "\"\ncells = " + std::to_string(cells) +
         (refinements > 0 ? "\nrefinements = " + std::to_string(refinements) : "") +
         "\n[method]\nelement = \"" + element + "\"\nsolver = \"" + solver + "\"\n" + method;
}

/// lib/cmake/mpi_environment.cmake says why; ranks that wait give way to whatever else runs.
constexpr auto environment = "env " MPI_ENVIRONMENT " OMPI_MCA_mpi_yield_when_idle=1 ";

/// A scene and its runs, on as many ranks as asked: 0 is without mpiexec.
class Runs {
 public:
  explicit Runs(const std::string& scene) {
    std::ofstream(folder / "scene.toml", std::ios::binary) << scene;
  }
  fs::path results(const std::string& name) const { return folder / name; }
  std::string command(int ranks, const std::string& name, const std::string& options = "") const {
    const std::string launch =
        ranks > 0 ? std::string(environment) + MPIEXEC " -n " + std::to_string(ranks) + " " : "";
    return launch + in_shell(RUN_SCENE) + " " + in_shell(folder / "scene.toml") + " --out " +
           in_shell(results(name).string()) + " " + options + " >" + in_shell(folder / "out") +
           " 2>" + in_shell(folder / "err");
  }
  Outcome run(int ranks, const std::string& name, const std::string& options = "") const {
    const int status = std::system(command(ranks, name, options).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder / "out"),
            contents(folder / "err")};
  }
  nlohmann::json summary(const std::string& name) const {
    return nlohmann::json::parse(contents(results(name) / "summary.json"));
  }
  TemporaryFolder folder;
};

/// Rows by place: the ranks write theirs in another order.
Eigen::MatrixXd sorted(const Eigen::MatrixXd& rows) {
  std::vector<Eigen::RowVectorXd> all(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) all[i] = rows.row(i);
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.begin() + 2, b.begin(), b.begin() + 2);
  });
  Eigen::MatrixXd result(rows.rows(), rows.cols());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) result.row(i) = all[i];
  return result;
}

/// What run_scene itself says on standard error: mpiexec adds lines of its own, all without the
/// file's name.
int lines_about(const std::string& name, const std::string& err) {
  std::istringstream text(err);
  int count = 0;
  for (std::string line; std::getline(text, line);)
    count += line.find(name) != std::string::npos ? 1 : 0;
  return count;
}

/// The same question, serially and on each number of ranks: the same files, on as many levels as
/// said.
void expect_the_files_of_the_serial_run(const Runs& serial, const Runs& petsc,
                                        const std::vector<int>& all_ranks, int levels) {
  ASSERT_EQ(serial.run(0, "serial").status, 0) << contents(serial.folder / "err");
  const Eigen::MatrixXd u = sorted(read_csv(serial.results("serial") / "solution.csv").rows);
  const Eigen::MatrixXd contact = read_csv(serial.results("serial") / "contact.csv").rows;
  for (const int ranks : all_ranks) {
    const std::string name = std::to_string(ranks);
    const Outcome outcome = petsc.run(ranks, name);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("WARNING"), std::string::npos) << outcome.out;  // one of PETSc
    const Csv mine = read_csv(petsc.results(name) / "solution.csv"),
              table = read_csv(petsc.results(name) / "contact.csv");
    EXPECT_EQ(mine.header, "x,y,u");
    EXPECT_EQ(table.header, "x,gap,pressure");
    ASSERT_EQ(mine.rows.rows(), u.rows());
    EXPECT_LE((sorted(mine.rows) - u).cwiseAbs().maxCoeff(), 1e-9 * u.col(2).cwiseAbs().maxCoeff());
    ASSERT_EQ(table.rows.rows(), contact.rows());
    EXPECT_LE((table.rows - contact).leftCols<2>().cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LE((table.rows - contact).col(2).cwiseAbs().maxCoeff(),
              1e-6 * contact.col(2).maxCoeff());
    const nlohmann::json ours = petsc.summary(name), theirs = serial.summary("serial");
    for (const char* key : {"dofs", "contact"}) EXPECT_EQ(ours[key], theirs[key]);
    EXPECT_NEAR(ours["h"].get<double>(), theirs["h"].get<double>(), 1e-12);
    EXPECT_NEAR(ours["energy"].get<double>(), theirs["energy"].get<double>(), 1e-9);
    EXPECT_NEAR(ours["compliance"]["value"].get<double>(),
                theirs["compliance"]["value"].get<double>(), 1e-9);
    for (const char* key : {"normal", "moment"})  // as the pressures
      EXPECT_NEAR(ours["contact_force"][key].get<double>(),
                  theirs["contact_force"][key].get<double>(), 1e-6 * contact.col(2).maxCoeff());
    EXPECT_LE(ours["kkt"]["residual"].get<double>(), 1e-9);
    EXPECT_EQ(ours["parallel"]["ranks"], std::max(ranks, 1));
    EXPECT_EQ(ours["parallel"]["levels"], levels);
    for (int r = 0; r < std::max(ranks, 1); ++r)
      EXPECT_TRUE(fs::exists(petsc.results(name) / ("solution_" + std::to_string(r) + ".vtu")));
    EXPECT_NE(contents(petsc.results(name) / "solution.pvtu").find("solution_0.vtu"),
              std::string::npos);
    EXPECT_FALSE(fs::exists(petsc.results(name).string() + ".checkpoint"));
  }
}

TEST(PetscScene, GivesTheFilesOfTheSerialRunOnAnyNumberOfRanks) {
  const struct {
    const char *kind, *element;
    int cells, refinements, levels;
    std::vector<int> ranks;
  } cases[] = {{"structured", "P1", 64, 0, 3, {0, 1}}, {"structured", "P1", 64, 0, 2, {4}},
               {"structured", "CR", 32, 0, 2, {2}},    {"structured", "P1", 16, 1, 2, {2}},
               {"layered", "P1", 9, 2, 3, {3}},        {"layered", "CR", 9, 2, 3, {4}},
               {"unstructured", "CR", 9, 2, 3, {0, 3}}};
  for (const auto& [kind, element, cells, refinements, levels, ranks] : cases)
    expect_the_files_of_the_serial_run(
        Runs(scene_text("active-set", kind, element, cells, "", refinements)),
        Runs(scene_text("petsc", kind, element, cells, "", refinements)), ranks, levels);
}

TEST(PetscScene,
     RefinesABodyFromAFileOverALayerInColumns) {  // an L, and a bridge whose Sigma is in two pieces
  for (const bool pieces : {false, true}) {
    const TemporaryFolder folder;
    const std::string path = (folder / "body.msh").string();
    write_msh(path, extruded(pieces ? bridge(8) : l_shape(8), 1e-3));
    const auto text = [&](const std::string& solver) {
      std::string all = scene_text(solver, "file", pieces ? "CR" : "P1", 0, "", 2);
      return all.replace(all.find("cells = 0"), 9, "file = \"" + path + "\"");
    };
    expect_the_files_of_the_serial_run(Runs(text("active-set")), Runs(text("petsc")),
                                       {pieces ? 3 : 2}, 3);
  }
}

TEST(PetscScene, SolvesALayerWithoutColumnsFromAFile) {
  const TemporaryFolder folder;
  const std::string path = (folder / "any.msh").string();
  write_msh(path, jittered_mesh(12, 0.2));
  const auto text = [&](const std::string& solver) {
    std::string all = scene_text(solver, "file", "CR", 0, "", 1);
    return all.replace(all.find("cells = 0"), 9, "file = \"" + path + "\"");
  };
  expect_the_files_of_the_serial_run(Runs(text("active-set")), Runs(text("petsc")), {0, 3}, 2);
}

TEST(PetscScene, IsNoMoreExactThanAsked) {
  const Runs rough(scene_text("petsc", "structured", "P1", 64, "tolerance = 1e-3\n")),
      fine(scene_text("petsc", "structured", "P1", 64));
  ASSERT_EQ(rough.run(0, "results").status, 0);
  ASSERT_EQ(fine.run(0, "results").status, 0);
  const Eigen::VectorXd u = read_csv(fine.results("results") / "solution.csv").rows.col(2);
  const Eigen::VectorXd v = read_csv(rough.results("results") / "solution.csv").rows.col(2);
  EXPECT_LE((u - v).lpNorm<Eigen::Infinity>(), 1e-3 * u.lpNorm<Eigen::Infinity>());
  EXPECT_LT(rough.summary("results")["iterations"]["corrections"],
            fine.summary("results")["iterations"]["corrections"]);
}

TEST(PetscScene, ResultsNeverReplaceTheMeshTheyCameFrom) {
  const TemporaryFolder folder;
  for (const std::string name :
       {"solution.pvtu", "solution_0.vtu", "solution_1.vtu", "solution_2.vtu"}) {
    write_msh((folder / name).string(), structured_mesh(4));
    // pieces of an earlier run, without a gap
    const std::ofstream one(folder / "solution_1.vtu", std::ios::app),
        zero(folder / "solution_0.vtu", std::ios::app);
    std::string text = scene_text("petsc", "file", "P1", 0);
    text.replace(text.find("cells = 0"), 9, "file = \"" + (folder / name).string() + "\"");
    const Runs runs(text);
    fs::create_directory_symlink(folder.path(), runs.results("results"));
    const std::string before = contents(folder / name);
    const Outcome outcome = runs.run(0, "results");
    EXPECT_EQ(outcome.status, 2) << name;
    EXPECT_NE(outcome.err.find("would replace"), std::string::npos) << outcome.err;
    EXPECT_EQ(contents(folder / name), before);
  }
}

// The scene is known by the bytes of its mesh file. Those of a device or a pipe may never end.
TEST(PetscScene, AMeshFileThatNeverEndsIsRefused) {
  for (const std::string name : {"/dev/zero", "pipe"}) {
    std::string text = scene_text("petsc", "file", "P1", 0);
    text.replace(text.find("cells = 0"), 9, "file = \"" + name + "\"");
    const Runs runs(text);
    ASSERT_EQ(::mkfifo((runs.folder / "pipe").c_str(), 0600), 0);
    const int status = std::system(("timeout 60 " + runs.command(0, "results")).c_str());
    EXPECT_EQ(WEXITSTATUS(status), 2) << name;
    EXPECT_EQ(lines_about("is a folder, a device or a pipe", contents(runs.folder / "err")), 1)
        << contents(runs.folder / "err");
    EXPECT_FALSE(fs::exists(runs.results("results")));
  }
}

TEST(PetscScene, TheMeshItWritesIsTheMeshItUsed) {
  const Runs petsc(scene_text("petsc", "structured", "P1", 32));
  ASSERT_EQ(petsc.run(3, "petsc").status, 0);
  std::string text = scene_text("active-set", "file", "P1", 0);
  text.replace(text.find("cells = 0"), 9,
               "file = \"" + (petsc.results("petsc") / "mesh.msh").string() + "\"");
  const Runs again(text);
  const Outcome outcome = again.run(0, "again");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Csv mine = read_csv(petsc.results("petsc") / "solution.csv"),
            theirs = read_csv(again.results("again") / "solution.csv");
  ASSERT_EQ(mine.rows.rows(), theirs.rows.rows());
  EXPECT_LE((mine.rows - theirs.rows).cwiseAbs().maxCoeff(),
            1e-9);  // row for row: the order of the nodes
}

TEST(PetscScene, ABadQuestionIsRefusedOnEveryRankAlike) {
  const struct {
    std::string scene, says;
    int status;
  } cases[] = {
      {scene_text("petsc", "structured", "P1", 3), "4 ranks for 3 columns", 2},
      {scene_text("active-set", "structured", "P1", 16), "petsc", 2},
      {scene_text("petsc", "structured", "P1", 32, "tolerance = 1e-18\n"), "double precision", 3},
      {scene_text("petsc", "layered", "P1", 16, "", 8), "refinements", 2},
      {scene_text("petsc", "structured", "P2", 16), "P2", 2},
      {"[load]\nf = \"1/(x - 0.6)\"\n[mesh]\nkind = \"structured\"\ncells = 30\n[method]\nsolver = "
       "\"petsc\"\n",
       "not finite", 2},
  };
  for (const auto& [scene, says, status] : cases) {
    const Runs runs(scene);
    const Outcome outcome = runs.run(scene.find("cells = 3\n") != scene.npos ? 4 : 2, "results");
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_EQ(lines_about("scene.toml: ", outcome.err), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(runs.results("results")));
    EXPECT_FALSE(fs::exists(runs.results("results").string() + ".checkpoint"));
  }
}

TEST(PetscScene, ALimitOfTimeEndsItOnEveryRank) {
  for (const std::string& scene : {scene_text("petsc", "structured", "P1", 64),
                                   scene_text("petsc", "unstructured", "CR", 32)}) {
    const Runs runs(scene);
    const Outcome outcome = runs.run(2, "results", "--most-seconds 0.001");
    EXPECT_EQ(outcome.status, 3);
    EXPECT_EQ(lines_about("stopped as asked", outcome.err), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(runs.results("results")));
  }
}

TEST(PetscScene, ALimitOfMemoryIsSeenBeforeItIsMet) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer reserves 20 TB of addresses: nothing starts under the limit";
#endif
  const Runs runs(scene_text("petsc", "structured", "P1", 1024));
  const int status = std::system(("ulimit -v 1500000; " + runs.command(0, "results")).c_str());
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_EQ(lines_about("limit of this process", contents(runs.folder / "err")), 1)
      << contents(runs.folder / "err");
  EXPECT_FALSE(fs::exists(runs.results("results")));
}

TEST(PetscScene, AKilledRunLeavesACheckpointFromWhichAnotherStarts) {
  const Runs runs(scene_text("petsc", "structured", "P1", 256));
  const fs::path checkpoint = runs.results("results").string() + ".checkpoint";
  EXPECT_EQ(runs.run(2, "results", "--restart").status, 2);  // there is none yet
  const pid_t child = ::fork();
  if (child == 0) {
    ::setpgid(0, 0);
    ::setenv("PETSC_OPTIONS", "-pc_type bjacobi -sub_pc_type icc",
             1);  // slow, so that no machine ends it too soon
    ::execl("/bin/sh", "sh", "-c", ("exec " + runs.command(2, "results")).c_str(), nullptr);
    ::_exit(127);
  }
  for (int i = 0; i < 15000 && !fs::exists(checkpoint); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  ::kill(child, SIGTERM);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_NE(status, 0);
  ASSERT_TRUE(fs::exists(checkpoint));
  EXPECT_FALSE(fs::exists(runs.results("results")));
  const Outcome again = runs.run(3, "results", "--restart");  // on another number of ranks
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.out.find("restart from the contact set"), std::string::npos);
  EXPECT_FALSE(fs::exists(checkpoint));
  ASSERT_EQ(runs.run(2, "whole").status, 0);
  EXPECT_EQ(runs.summary("results")["contact"], runs.summary("whole")["contact"]);
  EXPECT_NEAR(runs.summary("results")["energy"].get<double>(),
              runs.summary("whole")["energy"].get<double>(), 1e-10);
}

// An option of PETSc may write files and load a library. An option of UCX, which Open MPI 5 links,
// may write files. A folder of examples may hold such options.
TEST(PetscScene, ReadsNoOptionsFromTheFolderInWhichItIsStarted) {
  const Runs runs(scene_text("petsc", "structured", "P1", 16));
  const std::map<std::string, std::string> options = {
      {".petscrc", "-ksp_view ascii:"},
      {"petscrc", "-ksp_view ascii:"},
      {"ucx.conf", "UCX_LOG_LEVEL=debug\nUCX_LOG_FILE="}};
  for (const auto& [name, option] : options) {
    const std::string marker = "marker_of" + name;
    std::ofstream(runs.folder / name) << option << marker << "\n";
    for (const int ranks : {0, 2}) {
      const std::string start = "cd " + in_shell(runs.folder.path().string()) + " && ";
      EXPECT_EQ(std::system((start + runs.command(ranks, "results")).c_str()), 0)
          << contents(runs.folder / "err");
      EXPECT_FALSE(fs::exists(runs.folder / marker)) << ranks;
    }
    fs::remove(runs.folder / name);
  }
}

TEST(PetscScene, ACheckpointOfAnotherSceneOrADamagedOneIsRefused) {
  const Runs runs(scene_text("petsc", "structured", "P1", 64));
  const fs::path checkpoint = runs.results("results").string() + ".checkpoint";
  for (const std::string text :
       {R"({"question": "0123456789abcdef", "cells": 32, "x": [0.5], "active": [1]})",
        R"({"question": "0123456789abcdef", "cells": 32, "x": [0.5], "act)",
        R"({"question": "0123456789abcdef", "cells": 32, "x": [0.5], "active": []})", ""}) {
    std::ofstream(checkpoint, std::ios::binary) << text;
    const Outcome outcome = runs.run(2, "results", "--restart");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(lines_about("--restart", outcome.err), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(runs.results("results")));
  }
}

}  // namespace
}  // namespace antilock::test
