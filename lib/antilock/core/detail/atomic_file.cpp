#include "antilock/core/detail/atomic_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

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

[[noreturn]] void refuse_folder(const fs::path& folder, const std::string& reason) {
  throw Error(fmt::format("{}: {}; accepted: a folder that can be made and written", folder.string(), reason));
}

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

void check_folder(const fs::path& folder) {
  if (folder.empty())
    throw Error("the results folder has an empty name; accepted: a folder that can be made and written");
  try {
    const fs::path part = existing_part(folder);
    if (!fs::is_directory(part)) refuse_folder(folder, part.string() + " is no folder");
    if (::access(part.c_str(), W_OK | X_OK) != 0) refuse_folder(folder, part.string() + " cannot be written");
  } catch (const fs::filesystem_error& error) {
    refuse_folder(folder, error.code().message());
  }
}

void write_folder(const fs::path& folder, const std::function<void(const fs::path&)>& write,
                  const std::vector<std::string>& stale) {
  check_folder(folder);
  try {
    const Draft draft(existing_part(folder));
    write(draft.path());
    stop_if_interrupted();
    fs::create_directories(folder);
    const FolderLock lock(folder);
    std::vector<fs::path> names;
    for (const auto& file : fs::directory_iterator(draft.path())) names.push_back(file.path().filename());
    for (const fs::path& name : names)
      if (fs::is_directory(folder / name)) refuse_folder(folder, name.string() + " is a folder there");
    for (const fs::path& name : names) fs::rename(draft.path() / name, folder / name);
    for (const std::string& name : stale) fs::remove(folder / name);
  } catch (const fs::filesystem_error& error) {
    refuse_folder(folder, error.code().message());
  }
}

}  // namespace antilock
