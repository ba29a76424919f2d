// What a computation may take: limits of the process and of its control groups are seen before they
// are reached.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "antilock/core/memory.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"

namespace antilock::test::core_test::memory_test {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

TEST(ControlGroups, LeaveWhatTheNarrowestOfThemLeaves) {
  const TemporaryFolder folder;
  const fs::path groups = folder / "groups", own = folder / "own";
  write(own, "0::/a/b\n");
  EXPECT_FALSE(left_by_control_groups(groups, own)) << "no limit is known";
  write(groups / "a/b/memory.max", "max\n");
  write(groups / "a/b/memory.current", "1000\n");
  EXPECT_FALSE(left_by_control_groups(groups, own)) << "unlimited";
  write(groups / "a/memory.max", "5000\n");  // the limit of the group above binds this one
  write(groups / "a/memory.current", "3000\n");
  EXPECT_EQ(left_by_control_groups(groups, own).value(), 2000);
  write(groups / "a/memory.stat", "anon 2500\nfile 500\n");  // files in memory make way
  EXPECT_EQ(left_by_control_groups(groups, own).value(), 2500);
  write(groups / "a/b/memory.max", "1200\n");
  EXPECT_EQ(left_by_control_groups(groups, own).value(), 200);
}

TEST(ControlGroups, OfVersion1AreReadToo) {
  const TemporaryFolder folder;
  const fs::path groups = folder / "groups", own = folder / "own";
  write(own, "5:cpu:/x\n4:memory:/jobs/mine\n0::/\n");  // a container sees the limit above alone
  write(groups / "memory/memory.limit_in_bytes", "9223372036854771712\n");
  write(groups / "memory/memory.usage_in_bytes", "700\n");
  EXPECT_FALSE(left_by_control_groups(groups, own)) << "what version 1 writes for no limit";
  write(groups / "memory/memory.limit_in_bytes", "900\n");
  EXPECT_EQ(left_by_control_groups(groups, own).value(), 200);
}

TEST(Memory, ThatNoProcessCanHaveIsRefusedInOneLine) {
  const std::string said = refusal([] { require_memory(std::size_t{1} << 60, "solve"); });
  EXPECT_NE(said.find("solve: out of memory"), std::string::npos) << said;
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  EXPECT_NO_THROW(require_memory(1 << 20, "solve"));
}

// OpenBLAS #5289: it asks for its buffer again and again. In a child, whose limit leaves no room
// for it: where the solve does not throw, it never ends, and the alarm ends it.
TEST(Memory, ThatTheBlasCannotHaveEndsASolve) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "AddressSanitizer maps terabytes";
#endif
  const Scene scene(Body{paper_load}, StiffLayer{1e-3}, UnilateralContact{});
  const Space space(structured_mesh(16), p1());
  const VariationalInequality problem = assemble(scene, space);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::alarm(20);
    std::ifstream statm("/proc/self/statm");
    rlim_t pages = 0;
    statm >> pages;
    const rlim_t now = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
    const rlimit limit{now + (64 << 20), now + (64 << 20)};  // half of the buffer
    ::setrlimit(RLIMIT_AS, &limit);
    try {
      active_set(problem);
    } catch (const NotConverged& failure) {
      ::_exit(std::string(failure.what()).find("out of memory") != std::string::npos ? 3 : 4);
    } catch (...) {
      ::_exit(5);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
  // 0: an earlier test of this process has solved, and OpenBLAS has its buffer
  EXPECT_TRUE(WEXITSTATUS(status) == 3 || WEXITSTATUS(status) == 0) << WEXITSTATUS(status);
}

}  // namespace antilock::test::core_test::memory_test
