#pragma once
#include "antilock/distributed/contact_loop.hpp"

namespace antilock::distributed {

/// How PETSc's own solver for variational inequalities ended. It vouches for nothing.
struct SnesviEnd {
  std::string reason;     ///< PETSc's name for why it stopped
  bool converged = true;  ///< what PETSc says
  int newton = 0;         ///< Newton steps
  int linear = 0;         ///< iterations of conjugate gradients, all steps
  int corrections = 0;    ///< of the penalty
  double largest = 0;     ///< of u on Gamma_C
};

/// An exhibit, to be compared against: SNESVI (vinewtonrsls: Newton on the reduced space of the free unknowns) on the
/// matrix of `problem`, with 200 Newton steps at most, in place of the linear solver of contact_loop.hpp. Each du
/// solves the inequality of A_delta with the bound lower - u and the right-hand side r1 + delta^-1 B' M r2.
///
/// `split` false: one correction from u = 0, as PETSc's solver comes. With PenaltyChoice::none the matrix is A1 +
/// compliance^-1 B' M B, in which A1 has lost its digits. `split` true: corrections until du is below 1e-10 of u, 20 at
/// most. PETSc's default line search gives up on fine meshes, since it compares residuals that are round-off: full
/// steps are taken. Every rank must call it.
SnesviEnd snesvi(const distributed::DistributedProblem& problem, distributed::State& state, bool split);

}  // namespace antilock::distributed
