#pragma once
#include <functional>

#include "antilock/measure/result.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Solves a scene on a space: `assemble` fills the discrete problem, active_set solves it and
/// checks the conditions of the inequality. Then report_locking reports whether the element locks.
/// If mesh and element do not decide this, it compares energies (analysis/locking_loss.hpp). The
/// discrete solution is right to the tolerance, or the result has a warning, or an exception is
/// thrown. Its distance from the exact solution depends on the mesh, and with a stiff layer on the
/// element. If the element locks, `Result::warning` says so. The report costs nothing if the mesh
/// or the element excludes locking, and otherwise a small part of the time of the solve. On
/// tetrahedra it can take as long as the solve, because Crouzeix-Raviart has more unknowns. Throws
/// Error where every unknown is fixed. `assemble` and active_set may throw as well.
Result solve(const Scene& scene, const Space& space, const ActiveSetOptions& options = {});

/// A function that solves a problem of the class, for example a lambda that calls uzawa with its
/// options.
using Solver = std::function<Solution(const VariationalInequality& problem)>;
/// Does the same with another solver.
Result solve(const Scene& scene, const Space& space, const Solver& solver);

}  // namespace antilock
