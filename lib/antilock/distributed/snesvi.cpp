#include "antilock/distributed/snesvi.hpp"

#include <petscsnes.h>

#include <cmath>

#include "antilock/distributed/ranks.hpp"

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

/// v >= bound (per owned row), K v = rhs off the contact set, from v = 0. Counts in `end`. A solver
/// of its own: PETSc keeps the sizes of the last contact set.
Vector solved(const DistributedProblem& problem, Vec rhs, const Eigen::VectorXd& bound, bool split,
              double load, SnesviEnd& end) {
  Vector v = problem.rows().vector();
  const Vector r = problem.rows().vector(), low = problem.rows().vector(),
               high = problem.rows().vector();
  Entries{low} = bound.cwiseMax(PETSC_NINFINITY);
  ok(VecSet(high, PETSC_INFINITY));
  Linear context{problem.k(), rhs};
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
    ok(SNESSetTolerances(solver, 1e-12 * load, 1e-6, 0, PETSC_DEFAULT, PETSC_DEFAULT));
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

SnesviEnd snesvi(const DistributedProblem& problem, State& state, bool split) {
  const int max_corrections = split ? 20 : 1;
  constexpr double tolerance = 1e-10;
  const DofMap& rows = problem.rows();
  const Vector u = rows.vector(), rhs = rows.vector();
  rows.owned_part(state.u, u);
  PetscReal load = 0;
  PetscReal moved = 0;
  PetscReal size = 0;
  rows.summed(rows.unclamped(problem.part().load), rhs);
  ok(VecNorm(rhs, NORM_2, &load));
  SnesviEnd end;
  for (bool settled = false; !settled && end.converged && end.corrections < max_corrections;
       ++end.corrections) {
    const Eigen::VectorXd r2 = problem.compatibility(state.u, state.p);
    rows.summed(problem.right_side(problem.equilibrium(state.u, state.p), r2), rhs);
    const Eigen::VectorXd bound = problem.lower() - Entries(u);
    const Vector du = solved(problem, rhs, bound, split, load, end);
    ok(VecAXPY(u, 1, du));
    ok(VecNorm(du, NORM_INFINITY, &moved));
    ok(VecNorm(u, NORM_INFINITY, &size));
    const Eigen::VectorXd step = rows.local(du);
    state.u += step;
    state.p += problem.stress_step(step, r2);
    settled = moved <= tolerance * size;
  }
  if (split) end.converged = end.converged && moved <= tolerance * size;
  double most = 0;
  for (int place = 0; place < rows.owned(); ++place) {
    const double value = state.u(rows.unknown(place)), bound = problem.lower()(place);
    state.active[place] = value <= bound + 1e-14 * size ? 1 : 0;
    if (std::isfinite(bound)) most = std::max(most, value);
  }
  end.largest = largest(most);
  return end;
}

}  // namespace antilock::distributed
