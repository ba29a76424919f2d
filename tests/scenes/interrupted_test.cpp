// run_scene stopped at any moment: the files of a whole answer, or none, and no draft.
#include <chrono>

#include "scenes/runner.hpp"
#include "support/scenes.hpp"

namespace antilock::test::interrupted_test {

TEST(InterruptedRun, LeavesAWholeAnswerOrNothing) {
  const TemporaryFolder input, log;
  std::ofstream(input / "scene.toml")
      << "[load]\nf = \"10*sin(2*pi*x)\"\n[layer]\nepsilon = 1e-3\n[contact]\n[mesh]\n"
         "kind = \"structured\"\ncells = 96\n[method]\nelement = \"CR\"\n";
  int whole = 0, nothing = 0;
  for (int i = 0; i < 24; ++i) {
    const TemporaryFolder output;
    const std::string signal = i % 3 == 0 ? "INT" : i % 3 == 1 ? "TERM" : "HUP";
    const std::string command = "timeout -s " + signal + " " + std::to_string(0.05 * (i + 1)) +
                                " " + in_shell(RUN_SCENE) + " " + in_shell(input / "scene.toml") +
                                " --out " + in_shell(output / "results") + " >" +
                                in_shell(log / "out") + " 2>&1";
    (void)!std::system(command.c_str());
    if (std::filesystem::is_empty(output.path())) {
      ++nothing;
      continue;
    }
    ++whole;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(output.path()), {}), 1)
        << signal << " " << i;
    for (const char* name :
         {"summary.json", "solution.csv", "contact.csv", "mesh.msh", "solution.vtu"})
      EXPECT_TRUE(std::filesystem::exists(output / "results" / name))
          << signal << " " << i << " " << name;
    EXPECT_EQ(output.file_count(), 5);
    if (whole == 3) break;  // it ends in less than that
  }
  EXPECT_GT(nothing, 0);
}

// arbor #2068, HiGHS #1593: Ctrl-C during minutes of work. The accuracy takes half a minute or
// more; the signal comes after 1.5 s, and a second is ten times as long as the end takes.
TEST(InterruptedRun, OfAnAccuracyEndsWithinASecond) {
  const TemporaryFolder input, log, output;
  std::ofstream(input / "scene.toml")
      << "[load]\nf = \"10*sin(2*pi*x)\"\n[layer]\nepsilon = 1e-6\n[contact]\n[mesh]\n"
         "kind = \"structured\"\ncells = 16\n[method]\naccuracy = 1e-3\n"
         "most_unknowns = 3e7\n";
  const auto begin = std::chrono::steady_clock::now();
  const int result = std::system(
      ("timeout -s INT 1.5 " + in_shell(RUN_SCENE) + " " + in_shell(input / "scene.toml") +
       " --out " + in_shell(output / "results") + " >" + in_shell(log / "out") + " 2>&1")
          .c_str());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(WEXITSTATUS(result), 124) << "ended before the signal";
  EXPECT_LT(seconds.count(), 2.5);
  EXPECT_TRUE(std::filesystem::is_empty(output.path()));
}

}  // namespace antilock::test::interrupted_test
