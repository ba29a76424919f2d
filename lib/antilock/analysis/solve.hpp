#pragma once
#include <functional>

#include "antilock/measure/result.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// Solves a scene on a space: `assemble` fills the discrete problem, active_set solves it and checks the conditions of
/// the inequality, and report_locking compares the energy with that of a layer which is free to move. The discrete
/// solution is right to the tolerance, or carries a warning, or an exception is thrown. How far it is from the exact
/// solution depends on the mesh, and with a stiff layer on the element: where the element locks,
/// `Result::warning` says so. The report costs nothing where the mesh tells that nothing can lock, and else a small part of
/// the solve. Throws Error where every unknown is fixed and as `assemble` does, and what active_set throws.
Result solve(const Scene& scene, const Space& space, const ActiveSetOptions& options = {});

/// A function that solves a problem of the class, for example a lambda that calls uzawa with its options.
using Solver = std::function<Solution(const VariationalInequality& problem)>;
/// The same by another solver.
Result solve(const Scene& scene, const Space& space, const Solver& solver);

}  // namespace antilock
