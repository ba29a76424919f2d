// core/atomic_file.cpp in a page: one program, no signals, no other process. Files are
// written in their places.
#include "antilock/core/atomic_file.hpp"

#include <fstream>
#include <limits>

#include "antilock/core/error.hpp"

namespace antilock {
namespace fs = std::filesystem;

void write_file(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  if (path.has_parent_path()) fs::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.precision(std::numeric_limits<double>::max_digits10);
  try {
    write(out);
  } catch (...) {  // no half of a file stays; a copy of it in memory would take the page's
    out.close();
    fs::remove(path);
    throw;
  }
  out.close();
  if (!out) throw Error(path.string() + ": cannot be written");
}

void check_folder(const fs::path&) {}

void write_folder(const fs::path& folder, const std::function<void(const fs::path&)>& write,
                  const std::vector<std::string>& known) {
  const auto clear = [&] {
    for (const std::string& name : known) fs::remove(folder / name);
  };
  clear();
  try {
    write(folder);
  } catch (...) {
    clear();
    throw;
  }
}

}  // namespace antilock
