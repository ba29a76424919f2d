#pragma once
#include <string>

namespace antilock {

/// A text that has the path of a file, and is in no folder: nobody else can change it, nothing lies
/// beside it, and it is gone with this object or with the process, however that ends.
class MemoryFile {
 public:
  /// Throws MeshError where the system has no memory for it.
  explicit MemoryFile(const std::string& text);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  /// For this process alone.
  std::string path() const;

 private:
  int descriptor_;
};

}  // namespace antilock
