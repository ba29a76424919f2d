#include "antilock/core/detail/atomic_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <limits>
#include <system_error>

#include "antilock/core/detail/draft.hpp"
#include "antilock/core/error.hpp"

namespace antilock {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw Error(fmt::format("{}: cannot be written: {}; accepted: a path in a folder that can be written", path.string(),
                          reason));
}

std::string reason_of(int error) { return error == 0 ? "the stream failed" : std::generic_category().message(error); }

}  // namespace

void write_file(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  if (!path.has_filename()) refuse(path, "it names no file");
  std::error_code error;
  if (fs::is_directory(path, error)) refuse(path, "it is a folder");
  // the rename below would put a plain file in its place
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) refuse(path, "it is a device, a pipe or a socket");

  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  try {
    stop_if_interrupted();
    const Draft draft(existing_part(folder));
    const fs::path unfinished = draft.path() / path.filename();
    errno = 0;
    std::ofstream out(unfinished, std::ios::binary | std::ios::trunc);
    if (!out) refuse(path, reason_of(errno));
    out.precision(std::numeric_limits<double>::max_digits10);
    write(out);
    out.close();  // a full disk may show here first
    if (!out) refuse(path, reason_of(errno));
    stop_if_interrupted();
    fs::create_directories(folder);
    fs::rename(unfinished, path);
  } catch (const fs::filesystem_error& error) {
    refuse(path, error.code().message());
  }
}

}  // namespace antilock
