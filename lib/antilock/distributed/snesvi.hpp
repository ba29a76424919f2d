#pragma once
#include "antilock/distributed/contact_loop.hpp"

namespace antilock::distributed {

/// The outcome of SNESVI, PETSc's own solver for variational inequalities. The library does not
/// check the solution.
struct SnesviEnd {
  std::string reason;  ///< PETSc's name for the reason why it stopped
  /// Whether PETSc reports convergence. With `split` the corrections must have converged as well.
  bool converged = true;
  int newton = 0;       ///< Newton steps
  int linear = 0;       ///< iterations of conjugate gradients, all steps
  int corrections = 0;  ///< of the penalty method
  double largest = 0;   ///< the largest u on Gamma_C, the contact boundary
};

/// Solves with SNESVI, for comparison, and writes the solution to `state`. It takes the place of
/// the linear solver of contact_loop.hpp. The method is vinewtonrsls (Newton on the reduced space
/// of the free unknowns), with at most 200 Newton steps. Each du solves the inequality with the
/// matrix A_delta of `problem`, the bound lower - u and the right-hand side r1 + delta^-1 B' M r2
/// (detail/distributed_problem.hpp).
///
/// With `split` false there is one correction. From u = 0 it is the solve that a user of SNESVI
/// would make without this library. With PenaltyChoice::none the matrix is then A1 + compliance^-1
/// B' M B, in which A1 has lost its digits. With `split` true there are corrections until du is
/// below 1e-10 of u, but at most 20. Full steps are then taken, because PETSc's default line search
/// fails on fine meshes, where it compares residuals that are round-off. Every rank must call it.
SnesviEnd snesvi(const distributed::DistributedProblem& problem, distributed::State& state,
                 bool split);

}  // namespace antilock::distributed
