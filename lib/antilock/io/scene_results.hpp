#pragma once
#include <filesystem>

#include "antilock/adapt/solve_to.hpp"
#include "antilock/io/scene_file.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Wall seconds of a run by stage: the scene and its mesh, the discrete problem with a look at its load, the factor, the
/// rest of the solve. The files are timed where they are written.
struct RunSeconds {
  double mesh = 0, assemble = 0, factor = 0, solve = 0;
};

/// Throws Error where the results in `folder`, or a file there with a name among `more`, would replace the scene or its
/// mesh file. Touches nothing.
void check_inputs_stay(const std::filesystem::path& folder, const std::filesystem::path& scene, const SceneFile& file,
                       std::vector<std::string> more = {});

/// The question in full, as JSON: title, load, layer, gap, mesh, method, version.
std::string question_json(const SceneFile& file);

/// The answer to a scene file, in `folder`: summary.json, solution.csv, contact.csv (with the effect only), mesh.msh
/// (MSH 2.2), solution.vtu; all of them or none. Columns and keys are those of `run_scene --help`. Gaps and pressures
/// that are negative by round-off are written as 0; the summary's `kkt` has them as they are. `warning` is
/// the summary's; `certified`, where an accuracy was asked for, gives its `certificate`. Throws Error where the folder cannot be written, NotConverged where a number is not finite.
void write_scene_results(const std::filesystem::path& folder, const SceneFile& file, const Space& space,
                         const VariationalInequality& problem, const Solution& solution, const RunSeconds& seconds,
                         const std::string& warning = "", const CertifiedSolution* certified = nullptr);

}  // namespace antilock
