#include "antilock/core/detail/draft.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <mutex>
#include <string>
#include <system_error>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

namespace fs = std::filesystem;

constexpr std::array deferred = {SIGINT, SIGTERM, SIGHUP};

// A handler may do next to nothing: it notes the signal, and the end of the last draft acts on it.
std::atomic<int> waiting = 0;
static_assert(std::atomic<int>::is_always_lock_free);
extern "C" void note(int signal) { waiting = signal; }

std::mutex counting;
int drafts = 0;
std::array<bool, deferred.size()> taken = {};

/// Signals that would end the process wait from the first draft on; those that the program handles or ignores are its
/// own business.
void defer_signals() {
  const std::lock_guard lock(counting);
  if (drafts++ > 0) return;
  for (std::size_t i = 0; i < deferred.size(); ++i) {
    struct sigaction now = {};
    ::sigaction(deferred[i], nullptr, &now);
    taken[i] = (now.sa_flags & SA_SIGINFO) == 0 && now.sa_handler == SIG_DFL;
    if (!taken[i]) continue;
    struct sigaction deferring = {};
    deferring.sa_handler = note;
    ::sigaction(deferred[i], &deferring, nullptr);
  }
}

void deliver_signals() {
  const std::lock_guard lock(counting);
  if (--drafts > 0) return;
  for (std::size_t i = 0; i < deferred.size(); ++i)
    if (taken[i]) std::signal(deferred[i], SIG_DFL);
  if (const int signal = waiting.exchange(0)) ::raise(signal);
}

}  // namespace

fs::path existing_part(const fs::path& folder) {
  fs::path part = fs::absolute(folder).lexically_normal();
  while (!fs::exists(part) && part != part.root_path()) part = part.parent_path();
  return part;
}

Draft::Draft(const fs::path& place) {
  defer_signals();
  std::string name = (place / ".draft-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    const int reason = errno;
    deliver_signals();
    throw fs::filesystem_error("draft", place, std::error_code(reason, std::generic_category()));
  }
  path_ = name;
}

Draft::~Draft() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  deliver_signals();
}

void stop_if_interrupted() {
  if (waiting != 0) throw Error("interrupted while writing; nothing is written");
}

FolderLock::FolderLock(const fs::path& folder)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  while (descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX) != 0 && errno == EINTR)
    if (waiting != 0) {
      ::close(descriptor_);
      stop_if_interrupted();
    }
}

FolderLock::~FolderLock() {
  if (descriptor_ < 0) return;
  ::flock(descriptor_, LOCK_UN);  // closing would leave it to a process forked meanwhile
  ::close(descriptor_);
}

}  // namespace antilock
