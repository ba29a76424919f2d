#pragma once
#include "antilock/distributed/inequality.hpp"

namespace antilock::distributed {

/// How PETSc's own solver for variational inequalities ended. It vouches for nothing.
struct SnesviEnd {
  std::string reason;  ///< PETSc's name for why it stopped
  bool converged;      ///< what PETSc says
  int newton = 0;      ///< Newton steps
  int linear = 0;      ///< iterations of conjugate gradients, all steps
  double largest = 0;  ///< of u on Gamma_C
};

/// An exhibit, to be compared against: SNESVI (vinewtonrsls: Newton on the reduced space of the free unknowns) as it
/// comes, on the matrix of `problem`, with `most_steps` Newton steps at most. With a problem made with `summed` the
/// matrix is A1 + compliance^-1 B' M B, in which A1 has lost its digits. Every rank must call it.
SnesviEnd snesvi(const Inequality& problem, int most_steps = 200);

}  // namespace antilock::distributed
