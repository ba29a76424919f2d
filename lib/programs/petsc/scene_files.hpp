#pragma once
#include <filesystem>
#include <string>

#include "antilock/analysis/locking_report.hpp"
#include "antilock/distributed/nested.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/runner/scene_file.hpp"

namespace antilock::distributed {

/// Writes the solution of all ranks into one folder, all files or none: summary.json, solution.csv
/// (up to most_csv_unknowns), contact.csv (with contact), mesh.msh, and solution.pvtu with a VTU
/// file per rank. Columns and keys are those of a run without MPI. Every rank must call it. Throws
/// the same exception on every rank.
void write_scene_files(const std::filesystem::path& folder, const SceneFile& file,
                       const NestedLevel& level, const NestedReport& report, int levels,
                       const std::optional<LockingReport>& layer, const std::string& warning,
                       const RunSeconds& seconds);

/// Returns the report on the locking of the solution on rank 0, and nothing on the other ranks. The
/// mesh of the solution is `coarse` after `refinements` refinements. If the element can lock, rank
/// 0 collects the whole solution. Every rank must call it.
std::optional<LockingReport> layer_report_of_all(const SceneFile& file, const TriangleMesh& coarse,
                                                 int refinements, const NestedLevel& level);

/// Above this number of unknowns solution.csv is not written, because such a long text is hardly of
/// use.
constexpr int most_csv_unknowns = 1'000'000;

}  // namespace antilock::distributed
