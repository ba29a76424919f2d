#pragma once
#include <filesystem>

namespace antilock {

/// The folder itself, or the nearest one above it that exists. Throws std::filesystem::filesystem_error.
std::filesystem::path existing_part(const std::filesystem::path& folder);

/// A folder for files on their way, made with a name of its own (`.draft-` and six random signs, never one that stood
/// there before), in a folder that exists: files then move to their places by renaming, within one file system.
/// It is gone with everything in it when the scope ends, whatever ended it: an error, or one of the signals SIGINT,
/// SIGTERM and SIGHUP. While drafts exist such a signal waits (unless the program handles it itself): writers call
/// stop_if_interrupted after each file, and the signal takes its effect when the last draft is gone. Only SIGKILL or a
/// power cut leaves a draft behind, which no later process touches.
class Draft {
 public:
  /// Throws std::filesystem::filesystem_error where `place` cannot be written.
  explicit Draft(const std::filesystem::path& place);
  ~Draft();
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Throws Error where a signal waits for the drafts to go.
void stop_if_interrupted();

/// Held while the files of one result take their places: two processes with one goal do not mix theirs, as far as the
/// file system of `folder` knows locks (NFS may not). The lock leaves no file. Throws Error where a signal ends the wait.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace antilock
