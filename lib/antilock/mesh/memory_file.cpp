#include "antilock/mesh/memory_file.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

MemoryFile::MemoryFile(const std::string& text)
    : descriptor_(::memfd_create("antilock", MFD_CLOEXEC)) {
  std::size_t written = 0;
  while (descriptor_ >= 0 && written < text.size()) {
    const ssize_t more = ::write(descriptor_, text.data() + written, text.size() - written);
    if (more < 0 && errno == EINTR) continue;
    if (more <= 0) break;
    written += static_cast<std::size_t>(more);
  }
  if (descriptor_ >= 0 && written == text.size()) return;
  const std::string why = std::generic_category().message(errno);
  if (descriptor_ >= 0) ::close(descriptor_);
  throw MeshError(fmt::format("a file in memory of {} bytes cannot be made: {}", text.size(), why));
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

std::string MemoryFile::path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

}  // namespace antilock
