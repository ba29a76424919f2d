#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "antilock/core/text.hpp"
#include "antilock/distributed/nested.hpp"

namespace antilock::distributed {

/// Does the same as write_folder of core/atomic_file.hpp for all ranks. Rank 0 makes the draft of
/// the folder, every rank calls `write` on it, and the files are moved to their places when all
/// ranks have finished. `write` may communicate. Operations that can fail on one rank must be
/// called in it by `collectively`. Every rank must call it. Throws the same exception on every
/// rank.
void write_folder_together(const std::filesystem::path& folder,
                           const std::function<void(const std::filesystem::path& draft)>& write,
                           const std::vector<std::string>& known = {});

/// Writes one file, to which the ranks write one after the other, so that no rank needs all of it.
/// `head` is the beginning of the file, and `part` writes the lines of this rank. With an empty
/// `head` an existing file is continued.
void write_in_turns(const std::filesystem::path& path, const std::string& head,
                    const std::function<void(Text&)>& part);

/// Writes `x,y,u`, one row per unknown in the order of the rows of the level. For P1 this is the
/// order of the nodes of write_msh_together.
void write_solution_csv_together(const std::filesystem::path& path, const NestedLevel& level);

/// Writes the whole mesh, MSH 2.2 with its physical groups. `space` is any space on the subdomain
/// of this rank.
void write_msh_together(const std::filesystem::path& path, const Space& space);

}  // namespace antilock::distributed
