#pragma once
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "antilock/adapt/solve_to.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/runner/scene_file.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

/// The picture's part of a run on several ranks.
std::string piece_name(int rank);
/// The names of all results that there may be in `folder`, those of an earlier run too, and of one on `ranks` ranks:
/// what a new result replaces or takes away.
std::vector<std::string> result_names(const std::filesystem::path& folder, int ranks = 0);
/// Throws Error where one of them is the scene, its mesh file or its geometry. Touches nothing.
void check_inputs_stay(const std::filesystem::path& folder, const std::filesystem::path& scene, const SceneFile& file,
                       int ranks = 0);

/// The numbers of summary.json, whoever solved the scene: one process or the ranks of a run with PETSc.
struct SceneSummary {
  double h = 0;  ///< mesh_width, or the same of all pieces
  std::int64_t unknowns = 0;
  double energy = 0, u_max = 0, u_min = 0;
  ContactZone zone;  ///< read with the effect alone
  Kkt kkt;
  int contact_steps = 0, corrections = 0;
  std::optional<LockingReport> layer;
  Eigen::MatrixXd at;  ///< a row per point of [at]: x, y, u, in plane strain x, y, u_x, u_y
  std::string warning;
  struct Parallel {
    int ranks = 0;
    std::string petsc;
    int levels = 0, linear_iterations = 0;
    double memory_mb = 0;
  };
  std::optional<Parallel> parallel;
};
SceneSummary summary_of(const SceneFile& file, const Result& result);

/// The text of summary.json, the only place of its keys, which are those of `run_scene --help`. `certified`, where an
/// accuracy was asked for, gives its `certificate`; `files` are the seconds spent on the other files. Throws
/// NotConverged where a number is not finite.
std::string summary_text(const SceneFile& file, const SceneSummary& summary, const RunSeconds& seconds, double files,
                         const CertifiedSolution* certified = nullptr);
/// The same as a file.
void write_summary(const std::filesystem::path& path, const SceneFile& file, const SceneSummary& summary,
                   const RunSeconds& seconds, double files, const CertifiedSolution* certified = nullptr);

/// Which files are asked for, of "csv", "mesh" and "vtu"; summary.json is always written.
using ResultFiles = std::set<std::string>;
/// From such words, or "summary", with commas between them. Throws Error, the option first.
ResultFiles result_files(const std::string& words);

/// The answer to a scene file, in `folder`: summary.json, solution.csv, contact.csv (with the effect only), mesh.msh
/// (MSH 2.2), solution.vtu; all that are asked for or none, and those of an earlier run that are not asked for go. Gaps
/// and pressures that are negative by round-off are written as 0; the summary's `kkt` has them as they are. Throws
/// Error where the folder cannot be written, NotConverged where a number is not finite.
void write_scene_results(const std::filesystem::path& folder, const SceneFile& file, const Result& result,
                         const SceneSummary& summary, const CertifiedSolution* certified, const ResultFiles& asked);

}  // namespace antilock
