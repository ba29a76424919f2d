#include "antilock/distributed/snesvi.hpp"

#include <petscsnes.h>

#include "antilock/distributed/detail/bounded_corrections.hpp"

namespace antilock::distributed {
namespace {

struct Linear {
  Mat k;
  Vec rhs;
};

PetscErrorCode residual(SNES, Vec u, Vec r, void* context) {  // r = K u - rhs
  const auto* problem = static_cast<const Linear*>(context);
  PetscErrorCode code = MatMult(problem->k, u, r);
  return code != 0 ? code : VecAXPY(r, -1, problem->rhs);
}

PetscErrorCode jacobian(SNES, Vec, Mat, Mat, void*) {
  return 0;
}  // K itself, which does not change

/// v >= bound, K v = rhs off the contact set. A solver of its own for each correction: PETSc keeps
/// the sizes of the last contact set.
Vector solved(const DistributedProblem& problem, const BoundedCorrection& correction, bool split,
              PetscEnd& end) {
  Vector v = problem.rows().vector();
  const Vector r = problem.rows().vector(), low = problem.rows().vector(),
               high = problem.rows().vector();
  Entries{low} = correction.bound.cwiseMax(PETSC_NINFINITY);
  ok(VecSet(high, PETSC_INFINITY));
  Linear context{problem.k(), correction.rhs};
  Handle<SNES, SNESDestroy> solver;
  ok(SNESCreate(PETSC_COMM_WORLD, &solver));
  ok(SNESSetType(solver, SNESVINEWTONRSLS));
  ok(SNESSetFunction(solver, r, residual, &context));
  ok(SNESSetJacobian(solver, problem.k(), problem.k(), jacobian, nullptr));
  ok(SNESVISetVariableBounds(solver, low, high));
  if (split) {
    SNESLineSearch search = nullptr;
    ok(SNESGetLineSearch(solver, &search));
    ok(SNESLineSearchSetType(search, SNESLINESEARCHBASIC));
    ok(SNESSetTolerances(solver, 1e-12 * correction.load, 1e-6, 0, PETSC_DEFAULT, PETSC_DEFAULT));
  }
  ok(SNESSetTolerances(solver, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, 200, PETSC_DEFAULT));
  ok(SNESSetFromOptions(solver));
  ok(SNESSolve(solver, nullptr, v));
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  PetscInt newton = 0;
  PetscInt linear = 0;
  ok(SNESGetConvergedReason(solver, &reason));
  ok(SNESGetIterationNumber(solver, &newton));
  ok(SNESGetLinearSolveIterations(solver, &linear));
  end.reason = SNESConvergedReasons[reason];
  end.converged = reason > 0;
  end.newton += static_cast<int>(newton);
  end.linear += static_cast<int>(linear);
  return v;
}

}  // namespace

PetscEnd snesvi(const DistributedProblem& problem, State& state, bool split) {
  return bounded_corrections(problem, state, split,
                             [&](const BoundedCorrection& correction, PetscEnd& end) {
                               return solved(problem, correction, split, end);
                             });
}

}  // namespace antilock::distributed
