#pragma once
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "antilock/adapt/solve_to.hpp"
#include "antilock/certificate/contact_force_bounds.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/runner/scene_file.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

/// Returns the name of the VTU file of one rank, in a run on several ranks.
std::string piece_name(int rank);
/// Returns the names of all files that a new result in `folder` replaces or removes, including
/// those of an earlier run and of a run on `ranks` ranks.
std::vector<std::string> result_names(const std::filesystem::path& folder, int ranks = 0);
/// Throws Error where one of these files is the scene, its mesh file or its geometry, or where one
/// of these names is a folder. Changes no file.
void check_inputs_stay(const std::filesystem::path& folder, const std::filesystem::path& scene,
                       const SceneFile& file, int ranks = 0);

/// The numbers of summary.json, for a run on one process or on several ranks with PETSc.
struct SceneSummary {
  double h = 0;  ///< mesh_width, or the same over all ranks
  std::int64_t unknowns = 0;
  double energy = 0, u_max = 0, u_min = 0;
  double compliance = 0;  ///< L(u), the work of the loads on u
  ContactZone zone;       ///< used only for a scene with contact
  ContactForce force;     ///< used only for a scene with contact
  /// With an accuracy, and where contact_force_bounds proves something.
  std::optional<ContactForceBounds> proved_force;
  Kkt kkt;
  int contact_steps = 0, corrections = 0;
  std::optional<LockingReport> layer;
  std::optional<FixedPointReport> coulomb;
  /// A row per point of [at]: x, y, in space z, then u, in plane strain u_x, u_y.
  Eigen::MatrixXd at;
  std::string warning;
  struct Parallel {
    int ranks = 0;
    std::string petsc;
    int levels = 0, linear_iterations = 0;
    double memory_mb = 0;
  };
  std::optional<Parallel> parallel;
};
/// Returns the summary of a result. `certified` is given for a scene with an accuracy, and contains
/// the result. Throws Error for a point of [at] outside the mesh.
SceneSummary summary_of(const SceneFile& file, const Result& result,
                        const CertifiedSolution* certified = nullptr);

/// Returns the interval in which the certificate proves the compliance L(u) of the exact solution
/// to lie. Where gap and prescribed displacements are 0, K is a cone with the vertex 0: v = 0 and
/// v = 2 u in the inequality give a(u, u) = L(u). So L(u) = -2 J(u), and the interval is that of
/// the energy times -2. The result is empty where the gap or a displacement is not 0 at an unknown.
std::optional<std::pair<double, double>> proved_compliance(const CertifiedSolution& certified);

/// Returns a table for the screen, one line per number: contact force and moments, the ends of
/// contact (in space the ranges of x and y), and the compliance, each with its interval, if there
/// is one, and its unit. `certified` is given for a scene with an accuracy.
std::string force_table(const SceneFile& file, const SceneSummary& summary,
                        const CertifiedSolution* certified = nullptr);

/// Returns the text of summary.json. Its keys are those of `run_scene --help`, and this function
/// alone writes them. `certified` is given for a scene with an accuracy, and becomes `certificate`.
/// `files` are the seconds spent on the other files. Throws NotConverged where a number is not
/// finite.
std::string summary_text(const SceneFile& file, const SceneSummary& summary,
                         const RunSeconds& seconds, double files,
                         const CertifiedSolution* certified = nullptr);
/// Writes this text to a file.
void write_summary(const std::filesystem::path& path, const SceneFile& file,
                   const SceneSummary& summary, const RunSeconds& seconds, double files,
                   const CertifiedSolution* certified = nullptr);

/// The requested files: "csv", "mesh" and "vtu". "summary" has no effect, because summary.json is
/// always written.
using ResultFiles = std::set<std::string>;
/// Reads such words, or "summary", separated by commas. Throws Error, whose message begins with the
/// name of the option, for any other word and for none.
ResultFiles result_files(const std::string& words);

/// Returns the folder of the results where none is named: results/NAME for the scene file
/// NAME.toml. Throws Error where NAME is no name of a folder, as in `...toml`, whose NAME is `..`,
/// and where results or results/NAME is a link: a scene is run in the folder that it came in, and a
/// link in it may lead to results of another one, which would be replaced and removed.
std::filesystem::path default_results_folder(const std::filesystem::path& scene);

/// Writes the results of a scene file into `folder`: summary.json, solution.csv, contact.csv (for a
/// scene with contact), mesh.msh (MSH 2.2) and solution.vtu. It writes all requested files or none,
/// and removes the other files of an earlier run. Gaps and pressures that are negative by round-off
/// are written as 0, unless the scene has a ceiling. The `kkt` of the summary contains them
/// unchanged. Throws Error where the folder cannot be written, and NotConverged where a number is
/// not finite.
void write_scene_results(const std::filesystem::path& folder, const SceneFile& file,
                         const Result& result, const SceneSummary& summary,
                         const CertifiedSolution* certified, const ResultFiles& asked);

}  // namespace antilock
