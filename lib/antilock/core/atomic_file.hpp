#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace antilock {

// Files on their way are in a draft: a folder `.draft-` and six random signs beside their goal, from which they move to
// their places by renaming, within one file system. A draft is gone with everything in it whatever ended the writing:
// an error, or one of the signals SIGINT, SIGTERM and SIGHUP. Such a signal waits (unless the program handles it
// itself) until the last draft is gone. Only SIGKILL or a power cut leaves a draft behind, which no later process
// touches.

/// Writes a file whole or not at all: `write` fills a stream, which then takes the place of `path` in one rename.
/// Folders are made. Numbers are written with 17 significant digits. Throws Error where the folder cannot be written.
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

/// Throws Error where writing `path` would replace one of the inputs, under whatever name. An empty path names no file.
void check_not_an_input(const std::filesystem::path& path, const std::vector<std::filesystem::path>& inputs);

/// Throws Error where `folder` could not be made or written: better now than after minutes of work. Touches nothing.
void check_folder(const std::filesystem::path& folder);

/// Writes the files of one result, all or none: `write` fills a draft, whose files then take their places in `folder`,
/// which is made if absent. They do so under a lock: two processes with one folder do not mix theirs, as far as its
/// file system knows locks (NFS may not). Files of `known` names that an earlier result left there, and this one does
/// not have, go. Throws Error, and leaves nothing behind, where anything fails before the first file is in place.
void write_folder(const std::filesystem::path& folder, const std::function<void(const std::filesystem::path&)>& write,
                  const std::vector<std::string>& known = {});

}  // namespace antilock
