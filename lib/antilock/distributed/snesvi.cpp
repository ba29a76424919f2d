#include "antilock/distributed/snesvi.hpp"

#include <petscsnes.h>

#include <cmath>

#include "antilock/distributed/ranks.hpp"

namespace antilock::distributed {
namespace {

using NewtonSolver = Handle<SNES, SNESDestroy>;

struct Problem {
  Mat k;
  Vec load;
};

PetscErrorCode residual(SNES, Vec u, Vec r, void* context) {  // r = K u - L
  const auto* problem = static_cast<const Problem*>(context);
  PetscErrorCode code = MatMult(problem->k, u, r);
  return code != 0 ? code : VecAXPY(r, -1, problem->load);
}

PetscErrorCode jacobian(SNES, Vec, Mat, Mat, void*) { return 0; }  // K itself, which does not change

}  // namespace

SnesviEnd snesvi(const Inequality& problem, int most_steps) {
  const Rows& rows = problem.rows();
  const auto plain = [&] {  // without room for ghosts: SNESVI takes its vectors apart
    Vector v;
    ok(MatCreateVecs(problem.k(), &v, nullptr)), ok(VecSet(v, 0));
    return v;
  };
  const Vector u = plain(), r = plain(), lower = plain(), upper = plain(), load = plain(), ghosted = rows.vector();
  rows.summed(problem.part().load, ghosted);
  ok(VecCopy(ghosted, load)), ok(VecSet(upper, PETSC_INFINITY));
  PetscScalar* bound = nullptr;
  ok(VecGetArray(lower, &bound));
  for (int i = 0; i < rows.owned(); ++i)
    bound[i] = std::isinf(problem.lower()(i)) ? PETSC_NINFINITY : problem.lower()(i);
  ok(VecRestoreArray(lower, &bound));

  Problem context{problem.k(), load};
  NewtonSolver solver;
  ok(SNESCreate(PETSC_COMM_WORLD, &solver)), ok(SNESSetType(solver, SNESVINEWTONRSLS));
  ok(SNESSetFunction(solver, r, residual, &context)),
      ok(SNESSetJacobian(solver, problem.k(), problem.k(), jacobian, nullptr));
  ok(SNESVISetVariableBounds(solver, lower, upper));
  ok(SNESSetTolerances(solver, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, most_steps, PETSC_DEFAULT));
  ok(SNESSetFromOptions(solver)), ok(SNESSolve(solver, nullptr, u));
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  PetscInt newton = 0, linear = 0;
  ok(SNESGetConvergedReason(solver, &reason)), ok(SNESGetIterationNumber(solver, &newton));
  ok(SNESGetLinearSolveIterations(solver, &linear));

  SnesviEnd end{SNESConvergedReasons[reason], reason > 0, static_cast<int>(newton), static_cast<int>(linear), 0};
  const PetscScalar* values = nullptr;
  ok(VecGetArrayRead(u, &values));
  for (int i = 0; i < rows.owned(); ++i)
    if (!std::isinf(problem.lower()(i))) end.largest = std::max(end.largest, values[i]);
  ok(VecRestoreArrayRead(u, &values));
  end.largest = largest(end.largest);
  return end;
}

}  // namespace antilock::distributed
