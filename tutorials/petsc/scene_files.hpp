#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/distributed/nested.hpp"
#include "antilock/io/scene_file.hpp"
#include "antilock/measure/answer.hpp"

namespace antilock::distributed {

/// The answer of all ranks in one folder, all files or none: summary.json, solution.csv (up to a million unknowns),
/// contact.csv (with contact), mesh.msh, solution.pvtu with a piece per rank. Columns and keys are those of a run
/// without MPI. Every rank must call it; throws on every rank alike.
void write_scene_files(const std::filesystem::path& folder, const SceneFile& file, const Level& level,
                       const NestedReport& report, int levels, const std::string& warning, const RunSeconds& seconds);

/// solution.pvtu and its pieces: those that write_scene_files writes to the folder and those there that it removes.
std::vector<std::string> piece_files(const std::filesystem::path& folder);

/// Beyond, the text of solution.csv serves nobody.
constexpr int most_csv_unknowns = 1'000'000;

}  // namespace antilock::distributed
