#include "antilock/core/atomic_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <functional>
#include <limits>
#include <system_error>
#include <thread>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw Error(fmt::format("{}: cannot be written: {}; accepted: a path in a folder that can be written", path.string(),
                          reason));
}

std::string reason_of(int error) { return error == 0 ? "the stream failed" : std::generic_category().message(error); }

/// The half-written file: it stands beside its goal, since a rename is atomic within one file system only, and it is
/// gone when the scope ends, whatever ended it.
class Unfinished {
 public:
  explicit Unfinished(const fs::path& goal) : path_(goal) {
    const auto thread = std::hash<std::thread::id>{}(std::this_thread::get_id());
    path_ += fmt::format(".{}-{:x}.part", ::getpid(), thread);
  }
  ~Unfinished() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

void write_file(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  if (!path.has_filename()) refuse(path, "it names no file");
  std::error_code error;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
  if (error) refuse(path, error.message());
  if (fs::is_directory(path, error)) refuse(path, "it is a folder");
  // the rename below would put a plain file in its place
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) refuse(path, "it is a device, a pipe or a socket");

  const Unfinished unfinished(path);
  errno = 0;
  std::ofstream out(unfinished.path(), std::ios::binary | std::ios::trunc);
  if (!out) refuse(path, reason_of(errno));
  out.precision(std::numeric_limits<double>::max_digits10);
  write(out);
  out.close();  // a full disk may show here first
  if (!out) refuse(path, reason_of(errno));
  fs::rename(unfinished.path(), path, error);
  if (error) refuse(path, error.message());
}

}  // namespace antilock
