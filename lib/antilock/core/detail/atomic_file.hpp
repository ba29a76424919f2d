#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace antilock {

/// Writes a file whole or not at all: `write` fills a stream, which then takes the place of `path` in one rename.
/// Folders are made. A signal that ends the process leaves nothing behind (see Draft). Numbers are written with 17
/// significant digits. Throws Error where the folder cannot be written.
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

/// Throws Error where `folder` could not be made or written: better now than after minutes of work. Touches nothing.
void check_folder(const std::filesystem::path& folder);

/// Writes the files of one result, all or none: `write` fills a draft folder, whose files then take their places in
/// `folder`, which is made if absent. They do so under a lock: two processes with one folder do not mix theirs. Files
/// of `stale` that an earlier result left there go. Throws Error, and leaves nothing behind, where anything fails
/// before the first file is in place. A signal that ends the process leaves all files or none, and no draft (see Draft).
void write_folder(const std::filesystem::path& folder, const std::function<void(const std::filesystem::path&)>& write,
                  const std::vector<std::string>& stale = {});

}  // namespace antilock
