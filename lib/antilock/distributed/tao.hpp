#pragma once
#include "antilock/distributed/contact_loop.hpp"
#include "antilock/distributed/petsc_end.hpp"

namespace antilock::distributed {

/// Two methods of TAO, PETSc's optimisers, for bounds and a Hessian: Newton's method on the
/// unknowns off the bounds, by conjugate gradients in a trust region. The step is shortened by a
/// line search (bnls), or by a smaller radius of the region (bntr).
enum class TaoMethod { bnls, bntr };

/// Does what snesvi does (snesvi.hpp), with a method of TAO in place of SNESVI: each du minimises
/// v' A_delta v / 2 - rhs' v for v >= lower - u. The preconditioner is BoomerAMG. TAO compares
/// values of this energy, where SNESVI compares residuals. There are at most 200 steps. Every rank
/// must call it.
PetscEnd tao(const DistributedProblem& problem, State& state, TaoMethod method, bool split);

}  // namespace antilock::distributed
