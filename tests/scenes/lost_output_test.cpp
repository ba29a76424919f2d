// What the programs write arrives, or they end with another status than 0: standard output on a
// full disk or closed, and files that are cut off.
#include <sys/wait.h>

#include <fstream>
#include <sstream>
#include <vector>

#include "scenes/runner.hpp"
#include "support/scenes.hpp"

namespace antilock::test::lost_output_test {

const char* const scene =
    "[load]\nf = \"10*sin(2*pi*x)\"\n[layer]\nepsilon = 1e-3\n[contact]\n[mesh]\nkind = "
    "\"structured\"\ncells = 8\n";

/// A folder with the scene, and commands run in it by a shell.
class LostOutput : public ::testing::Test {
 protected:
  void SetUp() override { std::ofstream(folder_ / "s.toml") << scene; }

  /// The status; standard error goes to the file `err`.
  int status_of(const std::string& command) const {
    const std::string line =
        "cd " + in_shell(folder_.path().string()) + " && { " + command + "; } 2>err";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// Standard error says it in its last line, and nothing else but what `truth` says of its method.
  void expect_one_line(const std::string& says, const std::string& of) const {
    std::istringstream err(contents(folder_ / "err"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(err, line);)
      if (line.rfind("antilock truth: exact", 0) != 0) lines.push_back(line);
    ASSERT_EQ(lines.size(), 1U) << of << ": " << err.str();
    EXPECT_NE(lines[0].find(says), std::string::npos) << of << ": " << err.str();
  }

  const TemporaryFolder folder_;
  const std::string antilock_ = in_shell(ANTILOCK_PROGRAM), run_scene_ = in_shell(RUN_SCENE);
};

// ClangBuildAnalyzer #2 (output cut off, status 0), CoreNeuron #91, OpenROAD #7875: the device that
// is always full.
TEST_F(LostOutput, OnAFullDiskIsNoSuccess) {
  std::ofstream points(folder_ / "many.csv");
  points << "x,y\n";
  for (int k = 0; k < 5000; ++k) points << k / 5000.0 << "," << -(k % 7) / 7.0 << "\n";
  points.close();
  std::ofstream(folder_ / "few.csv") << "x,y\n0.25,-1\n0.5,0\n";
  for (const std::string command : {"truth s.toml <few.csv", "truth s.toml <many.csv",
                                    "sweep s.toml --epsilon 1,0.1", "truth --help", "sweep --help",
                                    "judge --help", "lockcheck --help", "--help", "run --help"}) {
    EXPECT_EQ(status_of(antilock_ + " " + command + " >/dev/full"), 2) << command;
    expect_one_line("standard output: ",
                    command);  // the reason is known to the flush that failed first
  }
  EXPECT_EQ(status_of(run_scene_ + " --help >/dev/full"), 2);
  expect_one_line("standard output: ", "run_scene --help");
}

TEST_F(LostOutput, OfRunSceneLeavesNoFiles) {
  EXPECT_EQ(status_of(run_scene_ + " s.toml --out results >/dev/full"), 2);
  expect_one_line("standard output: No space left on device", "run_scene");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "results"));
}

// A descriptor that is free is given to the first file that is opened: what is printed must not
// stand in it.
TEST_F(LostOutput, OfAClosedStreamIsInNoFile) {
  EXPECT_EQ(status_of(run_scene_ + " s.toml --out results >&-"), 2);
  expect_one_line("standard output: Bad file descriptor", "run_scene");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "results"));
  EXPECT_EQ(status_of("printf 'x,y\\n0.25,-1\\n' | " + antilock_ +
                      " truth s.toml --summary summary.json >&-"),
            2);
  expect_one_line("standard output: Bad file descriptor", "truth");
  if (std::filesystem::exists(folder_ / "summary.json")) {
    EXPECT_EQ(contents(folder_ / "summary.json").find("x,y,u"), std::string::npos);
  }
}

// Files that end after 1 or 2 kB stand for a disk that is full half way.
TEST_F(LostOutput, OfAFileThatIsCutOffIsNoSuccess) {
  EXPECT_EQ(
      status_of("trap '' XFSZ; ulimit -f 2; " + run_scene_ + " s.toml --out results >/dev/null"),
      2);
  expect_one_line("File too large", "run_scene");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "results"));
  EXPECT_EQ(status_of("trap '' XFSZ; ulimit -f 0; " + antilock_ +
                      " sweep s.toml --epsilon 1,0.1 --out sweep.csv >/dev/null 2>&1"),
            2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "sweep.csv"));
}

}  // namespace antilock::test::lost_output_test
