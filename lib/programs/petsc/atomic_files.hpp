#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "antilock/core/text.hpp"
#include "antilock/distributed/nested.hpp"

namespace antilock::distributed {

/// write_folder of core/atomic_file.hpp for all ranks: rank 0 makes the draft, every rank runs `write` on it, and the
/// files take their places when all are done. `write` may communicate; what can fail on one rank it runs by
/// `collectively`. Every rank must call it; throws on every rank alike.
void write_folder_together(const std::filesystem::path& folder,
                           const std::function<void(const std::filesystem::path& draft)>& write,
                           const std::vector<std::string>& known = {});

/// One file that the ranks write one after the other, so that none of them holds all of it: `part` writes this rank's
/// lines, `head` what comes first. An existing file is continued where `head` is empty.
void write_in_turns(const std::filesystem::path& path, const std::string& head, const std::function<void(Text&)>& part);

/// `x,y,u`, one row per unknown in the order of the rows of the level: for P1 that of the nodes of write_msh_together.
void write_solution_csv_together(const std::filesystem::path& path, const NestedLevel& level);

/// The whole mesh, MSH 2.2 with its physical groups.
/// `space`: any on this rank's subdomain.
void write_msh_together(const std::filesystem::path& path, const Space& space);

}  // namespace antilock::distributed
