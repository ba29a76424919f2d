#pragma once
#include "antilock/distributed/detail/contact_loop.hpp"

namespace antilock::distributed {

/// How PETSc's own solver for variational inequalities ended. It vouches for nothing.
struct SnesviEnd {
  std::string reason;   ///< PETSc's name for why it stopped
  bool converged;       ///< what PETSc says
  int newton = 0;       ///< Newton steps
  int linear = 0;       ///< iterations of conjugate gradients, all steps
  int corrections = 1;  ///< of the penalty; in the split form alone
  double largest = 0;   ///< of u on Gamma_C
};

/// An exhibit, to be compared against: SNESVI (vinewtonrsls: Newton on the reduced space of the free unknowns) as it
/// comes, on the matrix of `problem`, with `most_steps` Newton steps at most. With a problem made with `summed` the
/// matrix is A1 + compliance^-1 B' M B, in which A1 has lost its digits. Every rank must call it.
SnesviEnd snesvi(const Inequality& problem, int most_steps = 200);

/// The same solver for the corrections of the split form: each du solves the inequality of K with the bound lower - u
/// and the right-hand side r1 + delta^-1 B' M r2, where r1 and r2 come from A1, B, M and p (contact_loop.hpp). PETSc's
/// default line search gives up on fine meshes, since it compares residuals that are round-off: full steps are taken.
/// Every rank must call it.
SnesviEnd snesvi_split(const Inequality& problem, State& state, double tolerance = 1e-10);

}  // namespace antilock::distributed
