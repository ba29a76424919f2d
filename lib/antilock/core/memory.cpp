#include "antilock/core/memory.hpp"

#include <fmt/format.h>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <algorithm>
#include <cmath>
#include <fstream>
#include <mutex>

#include "antilock/core/blas.hpp"
#include "antilock/core/error.hpp"

// Declared here, and absent with a BLAS that is not linked: the address is null then.
extern "C" [[gnu::weak]] void dsyrk_(const char* uplo, const char* transposed, const int* n,
                                     const int* k, const double* alpha, const double* a,
                                     const int* lda, const double* beta, double* c, const int* ldc);

namespace antilock {
namespace {

/// The first number behind `key`, or the first of the file where `key` is empty. Empty for "max"
/// and where there is none.
std::optional<double> number_in(const std::filesystem::path& path, const std::string& key = "") {
  std::ifstream in(path);
  for (std::string word; in >> word;) {
    if (!key.empty() && word != key) continue;
    if (!key.empty()) in >> word;
    if (word.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
    return std::stod(word);
  }
  return std::nullopt;
}

/// The files that say how much memory one control group leaves.
struct ControlFiles {
  const char *limit, *used, *cached;
};
constexpr ControlFiles version_1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_cache"};
constexpr ControlFiles version_2{"memory.max", "memory.current", "file"};

std::optional<double> left_by(const std::filesystem::path& group, const ControlFiles& files) {
  constexpr double no_limit = 1e18;  // version 1 writes the largest page-aligned 64-bit number
  const auto limit = number_in(group / files.limit), used = number_in(group / files.used);
  if (!limit || !used || *limit > no_limit) return std::nullopt;
  return *limit - *used + number_in(group / "memory.stat", files.cached).value_or(0);
}

std::mutex counting;
int inside = 0;   // threads in the BLAS now
int buffers = 0;  // that OpenBLAS is known to have: it keeps them

}  // namespace

bool can_map([[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
  void* const place = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                             MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (place == MAP_FAILED) return false;
  ::munmap(place, bytes);
#endif
  return true;
}

std::optional<double> left_by_control_groups(const std::filesystem::path& groups,
                                             const std::filesystem::path& own) {
  std::optional<double> least;
  std::ifstream lines(own);
  for (std::string line;
       std::getline(lines, line);) {  // "4:memory:/a/b" in version 1, "0::/a/b" in version 2
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool memory = ("," + controllers + ",").find(",memory,") != std::string::npos;
    if (!memory && !controllers.empty()) continue;
    const std::filesystem::path top = memory ? groups / "memory" : groups;
    // a group that this process does not see (a container's) has those above it all the same
    for (std::filesystem::path group = line.substr(second + 1);; group = group.parent_path()) {
      if (const auto left = left_by(top / group.relative_path(), memory ? version_1 : version_2))
        least = std::min(*left, least.value_or(*left));
      if (group.relative_path().empty()) break;
    }
  }
  return least;
}

void require_memory(std::size_t bytes, const std::string& what) {
  const auto refuse = [&](const std::string& why) {
    throw NotConverged(
        fmt::format(
            "{}: out of memory: {:.0f} MB more are needed, {}; accepted: a smaller problem, or a "
            "higher limit",
            what, std::ceil(double(bytes) / 1e6), why),
        1, 0);
  };
  if (!can_map(bytes)) refuse("the limit of this process (ulimit -v, ulimit -d) leaves less");
  constexpr std::size_t worth_asking = 64
                                       << 20;  // the files of the control groups are read in 0.1 ms
  if (bytes < worth_asking) return;
  const auto left = left_by_control_groups("/sys/fs/cgroup", "/proc/self/cgroup");
  if (left && *left < double(bytes))
    refuse(fmt::format("its control group leaves {:.0f} MB", *left / 1e6));
}

BlasCalls::BlasCalls() {
  const std::lock_guard lock(counting);
  if (inside + 1 > buffers && blas().threads > 0) {
    if (!can_map(blas_buffer))
      throw NotConverged(
          fmt::format("out of memory: the BLAS needs a buffer of {} MB, the limit of this process "
                      "(ulimit -v, ulimit -d) leaves less; accepted: a higher limit",
                      blas_buffer >> 20),
          1, 0);
    if (dsyrk_) {  // the smallest call that takes the buffer, before anything else takes the room
                   // for it
      const int one = 1;
      const double zero = 0;
      double c = 0;
      dsyrk_("U", "N", &one, &one, &zero, &zero, &one, &zero, &c, &one);
    }
    buffers = inside + 1;
  }
  ++inside;
}

BlasCalls::~BlasCalls() {
  const std::lock_guard lock(counting);
  --inside;
}

}  // namespace antilock
