#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace antilock {

/// The size in bytes of the buffer that OpenBLAS maps for each of its threads. It is OpenBLAS's
/// BUFFER_SIZE on x86-64 plus one page.
constexpr std::size_t blas_buffer = (std::size_t{128} << 20) + (1 << 12);

/// Returns whether the limits of the process (ulimit -v, ulimit -d) leave room for so many bytes at
/// once. It is always true on systems other than Linux. It may be called before other libraries are
/// initialised.
bool can_map(std::size_t bytes);

/// Throws NotConverged, whose message begins with `what`, where `bytes` more bytes are not
/// available. The limits of the process (ulimit -v, ulimit -d) are tested by a mapping that is
/// released at once. From 64 MB on, the limits of its control groups (those of a container) are
/// read as well, since the kernel grants more than they allow and kills the process later. Where
/// neither limit is known, it does nothing.
void require_memory(std::size_t bytes, const std::string& what);

/// Returns the bytes that this process may still use. Each control group of the process, and each
/// parent of one, leaves its limit minus its usage; the result is the smallest of these. Control
/// groups of version 2 are read, or the memory controller of version 1. Files that the kernel keeps
/// in memory count as free. The result is empty where there is no limit. `groups` is
/// /sys/fs/cgroup, `own` is /proc/self/cgroup.
std::optional<double> left_by_control_groups(const std::filesystem::path& groups,
                                             const std::filesystem::path& own);

/// While an object of this class exists, its thread may call the BLAS. OpenBLAS maps a buffer of at
/// most 128 MB for each simultaneous thread, at the first call. If this fails, it tries again
/// without end. Therefore the constructor throws NotConverged where there is no room for a buffer
/// that is still missing. It does nothing with another BLAS.
class BlasCalls {
 public:
  BlasCalls();
  ~BlasCalls();
  BlasCalls(const BlasCalls&) = delete;
  BlasCalls& operator=(const BlasCalls&) = delete;
};

}  // namespace antilock
