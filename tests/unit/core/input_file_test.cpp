// Regular files are read, and nothing that may never end.
#include "antilock/core/input_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <string>

#include "support/scenes.hpp"
#include "support/temporary_folder.hpp"

namespace antilock::test::core_test::input_file_test {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  const auto in = open_file(path, "name", "a file");
  return {std::istreambuf_iterator<char>(*in), std::istreambuf_iterator<char>()};
}

TEST(InputFile, IsReadByteByByte) {
  const TemporaryFolder folder;
  const std::string text("a\r\n\0\xff", 5);
  std::ofstream(folder / "file", std::ios::binary) << text;
  std::ofstream(folder / "empty");
  std::filesystem::create_symlink("file", folder / "link");
  EXPECT_EQ(text_of(folder / "file"), text);
  EXPECT_EQ(text_of(folder / "link"), text);
  EXPECT_EQ(text_of(folder / "empty"), "");
}

TEST(InputFile, ThatMayNeverEndIsRefused) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::filesystem::create_directory(folder / "folder");
  std::filesystem::create_symlink("/dev/zero", folder / "link");
  for (const fs::path& path :
       {folder / "pipe", folder / "folder", folder / "link", fs::path("/dev/zero")})
    EXPECT_EQ(refusal([&] { open_file(path, "name", "a file"); }),
              "name: is a folder, a device or a pipe; accepted: a file")
        << path;
  EXPECT_EQ(refusal([&] { open_file(folder / "absent", "name", "a file"); }),
            "name: cannot be opened; accepted: a file");
}

// Reading /proc/kmsg waits for the next message of the kernel.
TEST(InputFile, OfTheKernelIsEmpty) {
  EXPECT_EQ(text_of("/proc/self/status"), "");
  if (!std::filesystem::exists("/proc/kmsg")) return;  // a container may hide it
  EXPECT_EQ(text_of("/proc/kmsg"), "");
}

}  // namespace antilock::test::core_test::input_file_test
