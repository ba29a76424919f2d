// The command that run_scene prints to be copied is one that a shell reads as it is meant.
#include <sys/wait.h>

#include "scenes/runner.hpp"
#include "support/scenes.hpp"

namespace antilock::test::printed_command_test {

// openscad #846, I-Simpa #166, Slic3r #2645: paths with blanks and brackets.
TEST(PrintedCommand, IsReadByAShellAsItIsMeant) {
  for (const std::string name :
       {"plain", "my results (2)", "it's $HOME; `date`", "caf\xc3\xa9 & \"tea\""}) {
    const TemporaryFolder folder;
    std::ofstream(folder / "s.toml")
        << "[load]\nf = \"10*sin(2*pi*x)\"\n[mesh]\nkind = \"structured\"\ncells = 4\n";
    std::string quoted =
        "'";  // of the test's own: what the program's function does is what is tested
    for (const char c : (folder / name).string())
      quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    const Outcome outcome =
        run_scene(in_shell((folder / "s.toml").string()) + " --out " + quoted + "'", folder);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::string before = "a picture of it: ";
    const std::size_t from = outcome.out.find(before);
    ASSERT_NE(from, std::string::npos) << outcome.out;
    const std::string command = outcome.out.substr(
        from + before.size(), outcome.out.find('\n', from) - from - before.size());
    // the shell puts each word on a line of its own
    const std::string words = (folder / "words").string();
    ASSERT_EQ(std::system(("printf '%s\\n' " + command + " >" + in_shell(words)).c_str()), 0)
        << command;
    std::vector<std::string> lines;
    std::ifstream in(words);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    ASSERT_EQ(lines.size(), 5U) << command;
    EXPECT_EQ(lines[1], "surface");
    EXPECT_EQ(lines[2], (folder / name / "solution.vtu").string());
    EXPECT_TRUE(std::filesystem::exists(lines[2]));
    EXPECT_EQ(lines[4], (folder / name / "solution.png").string());
    if (name == "plain") {  // nothing to quote
      EXPECT_EQ(command.find('\''), std::string::npos) << command;
    }
  }
}

}  // namespace antilock::test::printed_command_test
