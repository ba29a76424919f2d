#pragma once
// The discrete problem of a scene file and its solution.
#include <functional>
#include <string>

#include "antilock/adapt/solve_to.hpp"
#include "antilock/core/progress.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/runner/scene_file.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// The discrete problem of a scene file on a space of its mesh: the scene's, or in plane strain that of two components
/// in this space (size 2 N). Throws Error.
VariationalInequality problem_of(const SceneFile& file, const Space& space);

/// Callbacks of solve_scene; an empty one costs nothing.
struct Callbacks {
  std::function<void(const std::string&)> stage;      ///< what begins now
  ProgressHook solve;                                 ///< may end a solve on one mesh, or a level of an accuracy
  std::function<void(const RefinementLevel&)> level;  ///< with an accuracy, after every level
};

/// Solves a scene file by its [method]: one solve on its mesh, whose history is empty, or with an accuracy as
/// many as it takes. `warning` is about the layer, the solve, the load, the displacements, the gap and the polygon, and
/// `locking` holds the layer's report. Throws Error, and NotConverged with how far it came, also where double precision goes no further than
/// asked.
CertifiedSolution solve_scene(const SceneFile& file, const Callbacks& follow);

/// The result with its normal bounds alone, by x: friction's stand behind them. What contact.csv and the zone are made of:
/// the bounds with u, lambda and active, and no matrix.
Result normal_contact(const Result& result);

}  // namespace antilock
