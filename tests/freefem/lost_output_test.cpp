// A script whose output does not arrive ends with status 2 and one line.
#include <sys/wait.h>

#include <cstdlib>

#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"

namespace antilock::test::lost_output_test {

int status_of(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string run(const std::string& script, const TemporaryFolder& folder) {
  return "'" ANTILOCK_FREEFEM_FOLDER "/run' " + script + " -cells 4 -out '" +
         (folder / "out").string() + "' 2>'" + (folder / "err").string() + "'";
}

void expect_one_line(const TemporaryFolder& folder, const std::string& says) {
  const std::string err = contents(folder / "err");
  EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
  EXPECT_NE(err.find(says), std::string::npos) << err;
}

// ClangBuildAnalyzer #2 (output cut off, status 0), CoreNeuron #91, OpenROAD #7875.
TEST(FreeFemOutput, ThatStandardOutputDoesNotTakeIsNoSuccess) {
  const TemporaryFolder folder;
  EXPECT_EQ(status_of(run("02_meshes", folder) + " >/dev/null"), 0) << contents(folder / "err");
  EXPECT_EQ(status_of(run("02_meshes", folder) + " >/dev/full"), 2);
  expect_one_line(folder, "standard output takes nothing");
  EXPECT_EQ(status_of("'" ANTILOCK_FREEFEM_FOLDER "/run' --check >/dev/full 2>'" +
                      (folder / "err").string() + "'"),
            2);
  expect_one_line(folder, "standard output takes nothing");
}

// Files of at most 512 bytes stand for the end of a disk. A script that writes 2 kB of results was
// content.
TEST(FreeFemOutput, ThatIsCutOffIsNoSuccess) {
  const TemporaryFolder folder;
  EXPECT_EQ(
      status_of("trap '' XFSZ; ulimit -f 1; " + run("08_crouzeix_raviart", folder) + " >/dev/null"),
      2);
  expect_one_line(folder, "solution.csv could not be written to its end");
  EXPECT_FALSE(std::filesystem::exists(folder / "out/solution.csv")) << "half of a table is left";
}

}  // namespace antilock::test::lost_output_test
