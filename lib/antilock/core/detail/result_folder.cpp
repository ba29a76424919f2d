#include "antilock/core/detail/result_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

#include "antilock/core/detail/draft.hpp"
#include "antilock/core/error.hpp"

namespace antilock {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_folder(const fs::path& folder, const std::string& reason) {
  throw Error(fmt::format("{}: {}; accepted: a folder that can be made and written", folder.string(), reason));
}

}  // namespace

void check_folder(const fs::path& folder) {
  if (folder.empty())
    throw Error("the results folder has an empty name; accepted: a folder that can be made and written");
  std::error_code error;
  fs::path part;
  try {
    part = existing_part(folder);
  } catch (const fs::filesystem_error& failure) {
    refuse_folder(folder, failure.code().message());
  }
  if (!fs::is_directory(part, error)) refuse_folder(folder, part.string() + " is no folder");
  if (::access(part.c_str(), W_OK | X_OK) != 0) refuse_folder(folder, part.string() + " cannot be written");
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
