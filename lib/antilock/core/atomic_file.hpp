#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace antilock {

// While files are written, they are in a draft: a folder beside their destination, named `.draft-`
// and six random characters. From there they move to their destination by renaming, within one file
// system. If an error or one of the signals SIGINT, SIGTERM and SIGHUP ends the writing, the draft
// is removed with everything in it. The signal ends the program after the last draft has been
// removed, unless the program handles such signals itself. Another signal, such as SIGKILL, SIGQUIT
// or SIGSEGV, or a power cut may leave a draft behind, which no later process changes.

/// Writes a whole file or none. `write` fills the stream of a temporary file, which is then renamed
/// to `path`. Missing folders are made. Numbers are written with 17 significant digits. Throws
/// Error where the folder cannot be written.
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

/// Throws Error where writing `path` would replace one of the inputs, under any name. An empty path
/// names no file.
void check_not_an_input(const std::filesystem::path& path,
                        const std::vector<std::filesystem::path>& inputs);

/// Throws Error where `folder` could not be made or written. It is called before a long
/// computation, so that no work is lost. It changes nothing.
void check_folder(const std::filesystem::path& folder);

/// Writes all files of one result, or none. `write` fills a draft. Its files then take their places
/// in `folder`, which is made if it does not exist. A lock keeps two processes from mixing their
/// files in one folder, if the file system has locks (NFS may not). Files of an earlier result are
/// removed if their names are in `known` and the new result does not have them. Throws Error, and
/// leaves nothing behind, where anything fails before the first file is in place.
void write_folder(const std::filesystem::path& folder,
                  const std::function<void(const std::filesystem::path&)>& write,
                  const std::vector<std::string>& known = {});

}  // namespace antilock
