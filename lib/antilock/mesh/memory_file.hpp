#pragma once
#include <string>

namespace antilock {

/// A file in memory: it has a path, but is in no folder. So no other program finds it by a name in
/// a folder. It ends with this object or with the process.
class MemoryFile {
 public:
  /// Throws MeshError where the system has no memory for it.
  explicit MemoryFile(const std::string& text);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  /// The path is valid in this process only.
  std::string path() const;

 private:
  int descriptor_;
};

}  // namespace antilock
