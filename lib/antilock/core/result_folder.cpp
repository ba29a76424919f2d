#include "antilock/core/result_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& folder, const std::string& reason) {
  throw Error(fmt::format("{}: {}; accepted: a folder that can be made and written", folder.string(), reason));
}

/// The folder itself, or the nearest one above it that exists: the draft stands there, within one file system with
/// its goal, so that files move by renaming.
fs::path existing_part(const fs::path& folder) {
  std::error_code error;
  fs::path part = fs::absolute(folder, error).lexically_normal();
  while (!error && !fs::exists(part, error) && part != part.root_path()) part = part.parent_path();
  if (error) refuse(folder, error.message());
  return part;
}

/// A folder that is gone when the scope ends, whatever ended it.
class Draft {
 public:
  explicit Draft(const fs::path& place) : path_(place / fmt::format(".draft-{}", ::getpid())) {
    std::error_code error;
    fs::create_directory(path_, error);
    if (error) refuse(path_, error.message());
  }
  ~Draft() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

void check_folder(const fs::path& folder) {
  if (folder.empty())
    throw Error("the results folder has an empty name; accepted: a folder that can be made and written");
  const fs::path part = existing_part(folder);
  std::error_code error;
  if (!fs::is_directory(part, error)) refuse(folder, part.string() + " is no folder");
  if (::access(part.c_str(), W_OK | X_OK) != 0) refuse(folder, part.string() + " cannot be written");
}

void write_folder(const fs::path& folder, const std::function<void(const fs::path&)>& write,
                  const std::vector<std::string>& stale) {
  check_folder(folder);
  const Draft draft(existing_part(folder));
  write(draft.path());

  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse(folder, error.message());
  const fs::directory_iterator files(draft.path());
  for (const auto& file : files)
    if (const fs::path goal = folder / file.path().filename(); fs::is_directory(goal, error))
      refuse(folder, goal.filename().string() + " is a folder there");
  for (const auto& file : fs::directory_iterator(draft.path())) {
    fs::rename(file.path(), folder / file.path().filename(), error);
    if (error) refuse(folder, error.message());
  }
  for (const std::string& name : stale) fs::remove(folder / name, error);
}

}  // namespace antilock
