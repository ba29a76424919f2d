// Programs under a limit of their address space: they answer, or end with status 3 and one line.
// None hangs.
#include <sys/wait.h>

#include "scenes/runner.hpp"
#include "support/scenes.hpp"

namespace antilock::test::memory_limit_test {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool can_be_limited = false;  // AddressSanitizer maps terabytes
#else
constexpr bool can_be_limited = true;
#endif

// OpenBLAS #5289 (it asks for a buffer that it does not get again and again), #4762. 24,448
// unknowns, which take 0.3 s and 400 MB. 90 MB do not suffice to load the program: then the loader
// says so.
TEST(MemoryLimit, EndsARunWithAnAnswerOrALine) {
  if (!can_be_limited) GTEST_SKIP() << "not under AddressSanitizer";
  int answered = 0, refused = 0;
  for (const int megabytes : {1000, 400, 300, 220, 180, 150, 130, 110})
    for (const std::string threads : {"", "OPENBLAS_NUM_THREADS=2 "})
      for (const std::string limit : {"-v", "-d"}) {
        const TemporaryFolder folder;
        std::ofstream(folder / "s.toml")
            << "[load]\nf = \"10*sin(2*pi*x)\"\n[layer]\nepsilon = 1e-6\n[contact]\n[mesh]\n"
               "kind = \"structured\"\ncells = 64\n[method]\nelement = \"CR\"\n";
        // timeout stands outside of the limit; its own status is 124
        const std::string command =
            "timeout 60 sh -c 'ulimit " + limit + " " + std::to_string(megabytes * 1024) +
            "; unset OPENBLAS_NUM_THREADS; " + threads + "exec \"$0\" \"$@\"' " +
            in_shell(RUN_SCENE) + " " + in_shell((folder / "s.toml").string()) + " --out " +
            in_shell((folder / "results").string()) + " >/dev/null 2>" +
            in_shell((folder / "err").string());
        const int result = std::system(command.c_str());
        const int status = WIFEXITED(result) ? WEXITSTATUS(result) : -1;
        const std::string err = contents(folder / "err"),
                          what = limit + " " + std::to_string(megabytes) + " " + threads;
        answered += status == 0;
        refused += status == 3;
        EXPECT_TRUE(status == 0 || status == 3) << what << ": " << status << " " << err;
        EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), status == 0 ? 0 : 1)
            << what << ": " << err;
        if (status != 0) {
          EXPECT_NE(err.find("out of memory"), std::string::npos) << what << ": " << err;
          EXPECT_FALSE(std::filesystem::exists(folder / "results")) << what;
        }
      }
  EXPECT_GT(answered, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace antilock::test::memory_limit_test
