#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>

namespace antilock {

/// Writes a file whole or not at all: `write` fills a stream, which then takes the place of `path` in one rename.
/// Folders are made. A signal that ends the process leaves nothing behind (see Draft). Numbers are written with 17
/// significant digits. Throws Error where the folder cannot be written.
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

}  // namespace antilock
