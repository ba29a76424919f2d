#pragma once
#include "antilock/distributed/contact_loop.hpp"
#include "antilock/distributed/petsc_end.hpp"

namespace antilock::distributed {

/// Solves with SNESVI, PETSc's own solver for variational inequalities, for comparison, and writes
/// the solution to `state`. It takes the place of the linear solver of contact_loop.hpp. The method
/// is vinewtonrsls (Newton on the reduced space of the free unknowns), with at most 200 Newton
/// steps. Each du solves the inequality with the matrix A_delta of `problem`, the bound lower - u
/// and the right-hand side r1 + delta^-1 B' M r2 (detail/distributed_problem.hpp).
///
/// With `split` false there is one correction. From u = 0 it is the solve that a user of SNESVI
/// would make without this library. With PenaltyChoice::none the matrix is then A1 + compliance^-1
/// B' M B, in which A1 has lost its digits. With `split` true there are corrections until du is
/// below 1e-10 of u, but at most 20. Full steps are then taken, because PETSc's default line search
/// fails on fine meshes, where it compares residuals that are round-off. Every rank must call it.
PetscEnd snesvi(const DistributedProblem& problem, State& state, bool split);

}  // namespace antilock::distributed
