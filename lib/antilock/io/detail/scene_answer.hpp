// A scene file answered: its discrete problem and solution, what is to be doubted, the summary and the other files.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "antilock/adapt/solve_to.hpp"
#include "antilock/analysis/lost_energy.hpp"
#include "antilock/core/detail/progress.hpp"
#include "antilock/io/scene_file.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/measure/detail/answer.hpp"

namespace antilock {

/// The discrete problem of a scene file on a space of its mesh: the scene's, or in plane strain that of two components
/// in this space (size 2 N). Throws Error.
VariationalInequality problem_of(const SceneFile& file, const Space& space);

/// Asks for the load at vertices and edges of a mesh from a file, and for the gap along Gamma_C: what has no value
/// there throws, and so does a gap that presses in where Gamma_C meets clamped edges. Throws Error, `FILE: KEY: ...`.
void check_on_mesh(const SceneFile& file, const TriangleMesh& mesh);

/// Empty, or a line about a load that the quadrature does not see as it is: its integrals of f, x f and y f over the
/// body are compared with those of a quarter of a million points (or more) spread over all triangles; off by more than
/// a twentieth of the integral of |f|, they are named. A spike narrower than that remains unseen.
std::string load_warning(const SceneFile& file, const Space& space, const VariationalInequality& problem);

/// Empty, or a line about displacements that jump: two groups of edges that meet with different values, or a formula.
/// No function of finite energy has them: with h the energy grows like |log h|.
std::string displacement_warning(const SceneFile& file, const TriangleMesh& mesh);

/// Empty, or a line about a boundary of a mesh from a file that looks like a curve: at six vertices or more it turns by
/// an angle up to that of a regular octagon. What is proved is proved of the polygon.
std::string polygon_warning(const SceneFile& file, const TriangleMesh& mesh);

/// Empty, or a line about a .geo or .brep file that has the name of the mesh file and that the scene does not name: the
/// mesh is refined without it.
std::string geometry_warning(const SceneFile& file);

/// Empty, or a line about an obstacle that is missed between the contact unknowns: the largest depth to which u_h sinks
/// into it, looked for at a hundred thousand places of Gamma_C, if above a twentieth of max |u_h|.
std::string gap_warning(const SceneFile& file, const Space& space, const Solution& solution);

/// Empty, or a line about a layer without a load in which u_h of Crouzeix-Raviart leaves the range of the values around it
/// by more than a twentieth of max |u_h|: no exact solution does, by the maximum principle.
std::string range_warning(const SceneFile& file, const Space& space, const Solution& solution);

/// Who follows the answer to a scene; an empty hook costs nothing.
struct Followers {
  std::function<void(const std::string&)> stage;  ///< what begins now
  ProgressHook solve;                             ///< may end a solve on one mesh, or a level of an accuracy
  std::function<void(const Level&)> level;        ///< with an accuracy, after every level
};

/// The answer to a scene file by its [method]: one solve on its mesh, whose history is empty, or with an accuracy as
/// many as it takes. `warning` is about the solve, the load, the displacements, the gap and the polygon; the layer's joins it in
/// summary_of. Throws Error, and NotConverged with how far it came, also where double precision goes no further than
/// asked.
CertifiedSolution answer_scene(const SceneFile& file, const Followers& follow);

/// Both texts, or the one that is not empty: warnings are a line.
std::string joined(const std::string& a, const std::string& b);

/// The normal bounds of an answer alone, by x: friction's stand behind them. What contact.csv and the zone are made of:
/// the bounds with u, lambda and active, and no matrix.
struct NormalContact {
  VariationalInequality problem;
  Solution solution;
};
NormalContact normal_contact(const Answer& answer);

/// report_layer; in plane strain what the mesh says of a coating: conforming elements lock off columns where the length
/// k by which they resist bending is not small beside the thickness (analysis/locking.hpp). Nothing is proved of it.
std::optional<LayerReport> layer_report_of(const SceneFile& file, const Answer& answer);

/// In plane strain, T values: the pressure, -lambda div u in rubber, minus the stress in y with a coating.
Eigen::VectorXd pressure_of(const SceneFile& file, const Answer& answer);

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
  std::optional<LayerReport> layer;
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
/// With the layer's report, whose warning comes first.
SceneSummary summary_of(const SceneFile& file, const Answer& answer);

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
void write_scene_results(const std::filesystem::path& folder, const SceneFile& file, const Answer& answer,
                         const SceneSummary& summary, const CertifiedSolution* certified, const ResultFiles& asked);

}  // namespace antilock
