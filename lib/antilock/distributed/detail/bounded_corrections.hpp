#pragma once
#include <functional>

#include "antilock/distributed/contact_loop.hpp"
#include "antilock/distributed/petsc_end.hpp"

namespace antilock::distributed {

/// The problem of one correction: minimise v' K v / 2 - rhs' v for v >= bound (per owned row). It
/// is split off from the problem of u. `load` is the norm of L, the size of residuals.
struct BoundedCorrection {
  Vec rhs;
  const Eigen::VectorXd& bound;
  double load;
};

/// Solves one correction by a solver of PETSc, from v = 0. Counts in `end`, and writes there why
/// the solver stopped, and whether it has converged.
using CorrectionSolver = std::function<Vector(const BoundedCorrection&, PetscEnd& end)>;

/// Solves the problem by a solver of PETSc and writes the solution to `state`. With `split` false
/// there is one correction, from u = 0. With `split` true there are corrections until du is below
/// 1e-10 of u, but at most 20. Every rank must call it.
PetscEnd bounded_corrections(const DistributedProblem& problem, State& state, bool split,
                             const CorrectionSolver& solve);

}  // namespace antilock::distributed
