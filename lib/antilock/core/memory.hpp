#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace antilock {

/// Bytes of the buffer that OpenBLAS maps for each of its threads: its BUFFER_SIZE on x86-64, where it is largest, and a
/// page.
constexpr std::size_t blas_buffer = (std::size_t{128} << 20) + (1 << 12);

/// Whether the limits of the process (ulimit -v, ulimit -d) leave room for so many bytes at once; true where the system
/// is none that is asked (Linux). It needs nothing that a library prepares when it is loaded.
bool can_map(std::size_t bytes);

/// Throws NotConverged, `what` first, where `bytes` more cannot be had: the limits of the process (ulimit -v, ulimit -d)
/// are asked by a mapping that is given back at once; the memory of its control groups (a container's limit) is
/// compared, since the kernel hands out more than they allow and kills the process later. Passes where neither is
/// known.
void require_memory(std::size_t bytes, const std::string& what);

/// The bytes that the control groups of this process leave it, the least of them and of those above: version 2, or the
/// memory controller of version 1. Files that the kernel keeps in memory count as free. Empty where there is no limit.
/// `groups` is /sys/fs/cgroup, `own` is /proc/self/cgroup.
std::optional<double> left_by_control_groups(const std::filesystem::path& groups, const std::filesystem::path& own);

/// While one exists, its thread may call the BLAS. OpenBLAS maps a buffer for each thread that is in it at the same
/// time, 128 MB at most, at the first call; where it gets none it asks again without end. The constructor throws
/// NotConverged where there is no room for one that is still missing. It does nothing with another BLAS.
class BlasCalls {
 public:
  BlasCalls();
  ~BlasCalls();
  BlasCalls(const BlasCalls&) = delete;
  BlasCalls& operator=(const BlasCalls&) = delete;
};

}  // namespace antilock
