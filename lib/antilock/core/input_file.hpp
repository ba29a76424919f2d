#pragma once
#include <filesystem>
#include <istream>
#include <memory>
#include <string>

namespace antilock {

/// Opens a regular file for reading, byte by byte as it is. Throws Error, `NAME: what is wrong;
/// accepted: ACCEPTED`, where it cannot be opened. A folder, a device or a pipe is refused before
/// it is opened, because reading it may never end. A file of length 0 is not opened, and the stream
/// is empty: the files of /proc have this length, and reading one of them may wait without end.
std::unique_ptr<std::istream> open_file(const std::filesystem::path& path, const std::string& name,
                                        const std::string& accepted);

}  // namespace antilock
