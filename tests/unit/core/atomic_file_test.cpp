// Whole files or none.
// Interrupted, or not alone.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <filesystem>
#include <string>

#include "antilock/core/atomic_file.hpp"
#include "antilock/mesh/write_msh.hpp"
#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"

namespace antilock::test::core_test::atomic_file_test {

namespace fs = std::filesystem;

TEST(WriteFile, MakesFoldersAndReplacesTheOldFile) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a/b/c.txt";
  for (const char* text : {"first, the longer one", "second"}) {
    write_file(path, [&](std::ostream& out) { out << text; });
    EXPECT_EQ(contents(path), text);
  }
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(WriteFile, AFailureHalfWayLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder folder;
  write_file(folder / "kept.txt", [](std::ostream& out) { out << "old"; });
  const auto fails = [](std::ostream& out) {
    out << std::string(1 << 20, 'x');
    throw Error("half way");
  };
  EXPECT_EQ(refusal([&] { write_file(folder / "kept.txt", fails); }), "half way");
  EXPECT_EQ(refusal([&] { write_file(folder / "new.txt", fails); }), "half way");
  EXPECT_EQ(contents(folder / "kept.txt"), "old");
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(WriteFile, ADeviceIsNotReplacedByAFile) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_NE(refusal([&] { write_file(folder / "pipe", [](std::ostream&) {}); }).find("a pipe"),
            std::string::npos);
  EXPECT_TRUE(std::filesystem::is_fifo(folder / "pipe"));
}

TEST(WriteFile, AFullDiskIsReportedAndLeavesNothing) {
  const TemporaryFolder folder;
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{1 << 16, before.rlim_max};  // writes beyond it fail like those on a full disk
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = refusal([&] { write_msh(folder / "mesh.msh", structured_mesh(64)); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(message.find("mesh.msh: cannot be written"), message.npos) << message;
  EXPECT_EQ(folder.file_count(), 0);
}

TEST(WriteFile, PathsThatCannotBeWrittenAreRefusedInOneLine) {
  const TemporaryFolder folder;
  write_file(folder / "file", [](std::ostream& out) { out << "a file, no folder"; });
  fs::create_directory(folder / "folder");
  for (const char* bad : {"file/below.csv", "file/deep/below.csv", "folder", "folder/"}) {
    const fs::path path = folder / bad;
    const std::string message =
        refusal([&] { write_file(path, [](std::ostream& out) { out << 1; }); });
    EXPECT_EQ(message.rfind(path.string() + ": cannot be written: ", 0), 0U) << message;
    EXPECT_EQ(message.find('\n'), message.npos);
  }
  EXPECT_NE(refusal([] { write_file("", [](std::ostream&) {}); }), "");
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(WriteFile, NumbersOnTheStreamReadBackAsTheSameDouble) {
  const TemporaryFolder folder;
  const double third = 1.0 / 3;
  write_file(folder / "x", [&](std::ostream& out) { out << third; });
  EXPECT_EQ(std::stod(contents(folder / "x")), third);
}

/// How the child process that runs `act` ended, sent `signal` as soon as it says that it is in the
/// middle (0: never).
int end_of_child(int signal,
                 const std::function<void(const std::function<void()>& in_the_middle)>& act) {
  std::array<int, 2> pipe{};
  EXPECT_EQ(::pipe(pipe.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    if (signal != 0)
      std::signal(signal, SIG_DFL);  // a shell lets what it starts in the background ignore SIGINT
    try {
      act([&] {
        (void)!::write(pipe[1], "x", 1);
        for (int i = 0; i < 20; ++i)
          ::usleep(10'000);  // a fifth of a second, in which the signal comes
      });
    } catch (const std::exception&) {
      ::_exit(9);
    }
    ::_exit(0);
  }
  char byte = 0;
  if (signal != 0 && ::read(pipe[0], &byte, 1) == 1) ::kill(child, signal);
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(pipe[0]);
  ::close(pipe[1]);
  return status;
}

/// Two files, the middle between them.
void write_two(const fs::path& folder, const std::function<void()>& in_the_middle) {
  write_folder(folder, [&](const fs::path& draft) {
    write_file(draft / "first", [](std::ostream& out) { out << 1; });
    in_the_middle();
    write_file(draft / "second", [](std::ostream& out) { out << 2; });
  });
}

TEST(Interrupted, AFolderBeingWrittenLeavesNothingAndTheProcessEndsByItsSignal) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    const int status = end_of_child(
        signal, [&](const auto& middle) { write_two(folder / "new/results", middle); });
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
    EXPECT_TRUE(fs::is_empty(folder.path()));
  }
}

TEST(Interrupted, AFileBeingWrittenLeavesTheOldOneAndNothingElse) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryFolder folder;
    write_file(folder / "kept", [](std::ostream& out) { out << "old"; });
    for (const char* name : {"kept", "deep/new"}) {
      const int status = end_of_child(signal, [&](const auto& middle) {
        write_file(folder / name, [&](std::ostream& out) {
          out << "half" << std::flush;
          middle();
        });
      });
      EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
    }
    EXPECT_EQ(contents(folder / "kept"), "old");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
  }
}

TEST(Interrupted, ASignalThatTheProgramIgnoresStopsNothing) {
  const TemporaryFolder folder;
  const int status = end_of_child(SIGHUP, [&](const auto& middle) {
    std::signal(SIGHUP, SIG_IGN);  // as under nohup
    write_two(folder / "results", middle);
  });
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  EXPECT_EQ(folder.file_count(), 2);
}

TEST(Interrupted, DraftsOfOthersAreNeverAdopted) {
  const TemporaryFolder folder;  // processes of two containers have the same numbers
  const std::string number = std::to_string(::getpid());
  write_file(folder / (".draft-" + number + "/stray"),
             [](std::ostream& out) { out << "another's"; });
  write_folder(folder.path(), [](const fs::path& draft) {
    write_file(draft / "mine", [](std::ostream& out) { out << "mine"; });
  });
  EXPECT_FALSE(fs::exists(folder / "stray"));
  EXPECT_EQ(contents(folder / (".draft-" + number + "/stray")), "another's");
}

TEST(TwoProcesses, WithOneFolderPlaceTheirFilesOneAfterTheOther) {
  const TemporaryFolder folder;
  write_file(folder / "results/first", [](std::ostream& out) { out << "mine"; });
  const int placing = ::open((folder / "results").c_str(), O_RDONLY);
  ASSERT_EQ(::flock(placing, LOCK_EX), 0);
  const pid_t other = ::fork();
  if (other == 0) {
    write_two(folder / "results", [] {});
    ::_exit(0);
  }
  for (int i = 0; i < 30; ++i) ::usleep(10'000);
  EXPECT_EQ(contents(folder / "results/first"), "mine");
  EXPECT_FALSE(fs::exists(folder / "results/second"));
  ::flock(placing, LOCK_UN);
  ::close(placing);
  int status = 0;
  ::waitpid(other, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(contents(folder / "results/first"), "1");
  EXPECT_EQ(contents(folder / "results/second"), "2");
}

}  // namespace antilock::test::core_test::atomic_file_test
