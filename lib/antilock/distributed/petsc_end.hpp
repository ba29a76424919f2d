#pragma once
#include <string>

namespace antilock::distributed {

/// The outcome of one of PETSc's own solvers of variational inequalities, SNESVI or TAO. The
/// library does not check the solution.
struct PetscEnd {
  std::string reason;  ///< PETSc's name for the reason why it stopped
  /// Whether PETSc reports convergence. With `split` the corrections must have converged as well.
  bool converged = true;
  int newton = 0;       ///< Newton steps
  int linear = 0;       ///< iterations of conjugate gradients, all steps
  int corrections = 0;  ///< of the penalty method
  double largest = 0;   ///< the largest u on Gamma_C, the contact boundary
};

}  // namespace antilock::distributed
