#pragma once
#include <filesystem>
#include <string>

#include "antilock/analysis/locking_report.hpp"
#include "antilock/distributed/nested.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/runner/scene_file.hpp"

namespace antilock::distributed {

/// The answer of all ranks in one folder, all files or none: summary.json, solution.csv (up to a million unknowns),
/// contact.csv (with contact), mesh.msh, solution.pvtu with a piece per rank. Columns and keys are those of a run
/// without MPI. Every rank must call it; throws on every rank alike.
void write_scene_files(const std::filesystem::path& folder, const SceneFile& file, const NestedLevel& level,
                       const NestedReport& report, int levels, const std::optional<LockingReport>& layer,
                       const std::string& warning, const RunSeconds& seconds);

/// What the answer says of its own locking, on rank 0 (empty on the others). `coarse` is the mesh that was refined so many
/// times; where it can lock, the whole answer is brought together. Every rank must call it.
std::optional<LockingReport> layer_report_of_all(const SceneFile& file, const TriangleMesh& coarse, int refinements,
                                                 const NestedLevel& level);

/// Beyond, the text of solution.csv serves nobody.
constexpr int most_csv_unknowns = 1'000'000;

}  // namespace antilock::distributed
