#include "antilock/core/atomic_file.hpp"

#include <dirent.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <memory>
#include <mutex>
#include <set>
#include <system_error>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
  throw Error(
      fmt::format("{}: cannot be written: {}; accepted: a path in a folder that can be written",
                  path.string(), reason));
}

[[noreturn]] void refuse_folder(const fs::path& folder, const std::string& reason) {
  throw Error(fmt::format("{}: {}; accepted: a folder that can be made and written",
                          folder.string(), reason));
}

/// The folder itself, or the nearest one above it that exists.
fs::path existing_part(const fs::path& folder) {
  fs::path part = fs::absolute(folder).lexically_normal();
  while (!fs::exists(part) && part != part.root_path()) {
    if (fs::is_symlink(part)) refuse_folder(folder, part.string() + " is a link to nothing");
    part = part.parent_path();
  }
  return part;
}

// A handler may do next to nothing: it notes the signal, and the end of the last draft acts on it.
std::atomic<int> waiting = 0;
static_assert(std::atomic<int>::is_always_lock_free);
extern "C" void note(int signal) { waiting = signal; }

void stop_if_interrupted() {
  if (waiting != 0) throw Error("interrupted while writing; nothing is written");
}

/// Signals whose handler is `from` get the handler `to`; those that the program handles or ignores
/// are its own business.
void change_handlers(void (*from)(int), void (*to)(int)) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now = {}, then = {};
    then.sa_handler = to;
    ::sigaction(signal, nullptr, &now);
    if ((now.sa_flags & SA_SIGINFO) == 0 && now.sa_handler == from)
      ::sigaction(signal, &then, nullptr);
  }
}

/// While one of them exists, signals that would end the process wait.
class Uninterrupted {
 public:
  Uninterrupted() {
    const std::lock_guard lock(counting);
    if (count++ == 0) change_handlers(SIG_DFL, note);
  }
  ~Uninterrupted() {
    const std::lock_guard lock(counting);
    if (--count > 0) return;
    change_handlers(note, SIG_DFL);
    if (const int signal = waiting.exchange(0)) ::raise(signal);
  }
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;

 private:
  inline static std::mutex counting;
  inline static int count = 0;
};

/// A draft in a folder that exists.
struct Draft {
  explicit Draft(const fs::path& place) {
    std::string name = (place / ".draft-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw fs::filesystem_error("draft", place, std::error_code(errno, std::generic_category()));
    path = name;
  }
  ~Draft() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Uninterrupted until_it_is_gone;
  fs::path path;
};

/// As write_folder, or, without `known`, a single file: its rename needs no lock. Throws
/// std::filesystem::filesystem_error, too.
void write_through_draft(const fs::path& folder, const std::function<void(const fs::path&)>& write,
                         const std::vector<std::string>* known = nullptr) {
  stop_if_interrupted();
  const Draft draft(existing_part(folder));
  write(draft.path);
  stop_if_interrupted();
  fs::create_directories(folder);
  // unlocked before it is closed: closing alone would leave the lock to a process forked meanwhile
  const std::unique_ptr<DIR, void (*)(DIR*)> placing(known ? ::opendir(folder.c_str()) : nullptr,
                                                     [](DIR* open) {
                                                       ::flock(::dirfd(open), LOCK_UN);
                                                       ::closedir(open);
                                                     });
  while (placing && ::flock(::dirfd(placing.get()), LOCK_EX) != 0 && errno == EINTR)
    stop_if_interrupted();
  std::set<std::string> names;
  for (const auto& file : fs::directory_iterator(draft.path)) names.insert(file.path().filename());
  std::set<std::string> touched = names;
  if (known) touched.insert(known->begin(), known->end());
  for (const std::string& name : touched)
    if (fs::is_directory(folder / name)) refuse_folder(folder, name + " is a folder there");
  for (const std::string& name : touched)
    if (names.contains(name))
      fs::rename(draft.path / name, folder / name);
    else
      fs::remove(folder / name);
}

}  // namespace

void write_file(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  if (!path.has_filename()) refuse(path, "it names no file");
  std::error_code error;
  if (fs::is_directory(path, error)) refuse(path, "it is a folder");
  // a rename would put a plain file in its place
  if (fs::exists(path, error) && !fs::is_regular_file(path, error))
    refuse(path, "it is a device, a pipe or a socket");

  const auto check = [&](const std::ofstream& out) {
    if (!out)
      refuse(path, errno == 0 ? "the stream failed" : std::generic_category().message(errno));
  };
  const auto fill = [&](const fs::path& draft) {
    errno = 0;
    std::ofstream out(draft / path.filename(), std::ios::binary | std::ios::trunc);
    check(out);
    out.precision(std::numeric_limits<double>::max_digits10);
    write(out);
    out.close();  // a full disk may show here first
    check(out);
  };
  try {
    write_through_draft(path.has_parent_path() ? path.parent_path() : fs::path("."), fill);
  } catch (const fs::filesystem_error& error) {
    refuse(path, error.code().message());
  }
}

void check_not_an_input(const fs::path& path, const std::vector<fs::path>& inputs) {
  for (const fs::path& input : inputs)
    if (std::error_code absent;
        !path.empty() && !input.empty() && fs::equivalent(path, input, absent))
      throw Error(fmt::format("{}: would replace {}, which is read; accepted: another file",
                              printable(path.string(), 1000), printable(input.string(), 1000)));
}

void check_folder(const fs::path& folder) {
  if (folder.empty())
    throw Error(
        "the results folder has an empty name; accepted: a folder that can be made and written");
  try {
    const fs::path part = existing_part(folder);
    if (!fs::is_directory(part)) refuse_folder(folder, part.string() + " is no folder");
    if (::access(part.c_str(), W_OK | X_OK) != 0)
      refuse_folder(folder, part.string() + " cannot be written");
  } catch (const fs::filesystem_error& error) {
    refuse_folder(folder, error.code().message());
  }
}

void write_folder(const fs::path& folder, const std::function<void(const fs::path&)>& write,
                  const std::vector<std::string>& known) {
  check_folder(folder);
  try {
    write_through_draft(folder, write, &known);
  } catch (const fs::filesystem_error& error) {
    refuse_folder(folder, error.code().message());
  }
}

}  // namespace antilock
