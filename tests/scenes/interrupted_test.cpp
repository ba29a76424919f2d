// run_scene stopped at any moment: the files of a whole answer, or none, and no draft.
#include "scenes/runner.hpp"
#include "support/scenes.hpp"

namespace antilock::test::interrupted_test {

TEST(InterruptedRun, LeavesAWholeAnswerOrNothing) {
  const TemporaryFolder input, log;
  std::ofstream(input / "scene.toml") << "[load]\nf = \"10*sin(2*pi*x)\"\n[layer]\nepsilon = 1e-3\n[contact]\n[mesh]\n"
                                         "kind = \"structured\"\ncells = 96\n[method]\nelement = \"CR\"\n";
  int whole = 0, nothing = 0;
  for (int i = 0; i < 24; ++i) {
    const TemporaryFolder output;
    const std::string signal = i % 3 == 0 ? "INT" : i % 3 == 1 ? "TERM" : "HUP";
    const std::string command = "timeout -s " + signal + " " + std::to_string(0.05 * (i + 1)) + " " +
                                in_shell(RUN_SCENE) + " " + in_shell(input / "scene.toml") + " --out " +
                                in_shell(output / "results") + " >" + in_shell(log / "out") + " 2>&1";
    (void)!std::system(command.c_str());
    if (std::filesystem::is_empty(output.path())) {
      ++nothing;
      continue;
    }
    ++whole;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(output.path()), {}), 1) << signal << " " << i;
    for (const char* name : {"summary.json", "solution.csv", "contact.csv", "mesh.msh", "solution.vtu"})
      EXPECT_TRUE(std::filesystem::exists(output / "results" / name)) << signal << " " << i << " " << name;
    EXPECT_EQ(output.file_count(), 5);
    if (whole == 3) break;  // it ends in less than that
  }
  EXPECT_GT(nothing, 0);
}

}  // namespace antilock::test::interrupted_test
