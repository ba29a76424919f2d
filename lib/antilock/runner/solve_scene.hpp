#pragma once
// The discrete problem of a scene file and its solution.
#include <functional>
#include <optional>
#include <string>

#include "antilock/adapt/solve_to.hpp"
#include "antilock/core/progress.hpp"
#include "antilock/measure/contact_zone.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/runner/scene_file.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Returns the discrete problem of a scene file on a space of its mesh. In plane strain both
/// components are in this space (2 N unknowns). Throws Error.
VariationalInequality problem_of(const SceneFile& file, const Space& space);

/// Callbacks of solve_scene. An empty one is not called.
struct Callbacks {
  /// Called with the name of each stage when it begins.
  std::function<void(const std::string&)> stage;
  /// Called during a solve; `false` ends it, on one mesh or on a level of an accuracy.
  ProgressHook solve;
  std::function<void(const RefinementLevel&)> level;  ///< called after every level of an accuracy
};

/// Solves a scene file by its [method]. Without an accuracy this is one solve on the mesh of the
/// scene, and the history is empty. With an accuracy there are as many solves as the refinement
/// needs. `warning` is about the layer, the solve, the load, the displacements, the gap and the
/// polygon, and `locking` is the report on the layer. Throws Error. Throws NotConverged, with the
/// accuracy that was reached, if the requested one is not reached, also where double precision does
/// not suffice for it.
CertifiedSolution solve_scene(const SceneFile& file, const Callbacks& follow);

/// Returns the result with its normal bounds only, ordered by x. The bounds of friction, which
/// follow them, are left out. It contains the bounds, u, lambda and active, which contact.csv and
/// the contact zone need, and no matrices.
Result normal_contact(const Result& result);

/// The contact of a solved scene, on an obstacle or between two bodies.
struct ContactResults {
  /// A row per bound: x, in space y, distance, pressure (measure/contact_zone.hpp).
  Eigen::MatrixXd table;
  ContactZone zone;
  ContactForce force;  ///< its tangential force is set for a model with friction
};
/// Returns the contact of a result; empty for a scene without contact. Between two bodies the force
/// is that on the upper body.
std::optional<ContactResults> contact_results(const SceneFile& file, const Result& result);

}  // namespace antilock
