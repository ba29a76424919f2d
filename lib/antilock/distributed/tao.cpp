#include "antilock/distributed/tao.hpp"

#include <fmt/format.h>
#include <petsctao.h>

#include "antilock/distributed/detail/bounded_corrections.hpp"

namespace antilock::distributed {
namespace {

struct Quadratic {
  Mat k;
  Vec rhs;
};

/// f = v' K v / 2 - rhs' v and its gradient g = K v - rhs.
PetscErrorCode energy(Tao, Vec v, PetscReal* f, Vec g, void* context) {
  const auto* problem = static_cast<const Quadratic*>(context);
  PetscScalar quadratic = 0;
  PetscScalar linear = 0;
  PetscErrorCode code = MatMult(problem->k, v, g);
  if (code == 0) code = VecDot(v, g, &quadratic);
  if (code == 0) code = VecDot(v, problem->rhs, &linear);
  *f = quadratic / 2 - linear;
  return code != 0 ? code : VecAXPY(g, -1, problem->rhs);
}

PetscErrorCode hessian(Tao, Vec, Mat, Mat, void*) { return 0; }  // K itself, which does not change

Vector solved(const DistributedProblem& problem, const BoundedCorrection& correction,
              TaoMethod method, bool split, PetscEnd& end) {
  Vector v = problem.rows().vector();
  const Vector low = problem.rows().vector(), high = problem.rows().vector();
  Entries{low} = correction.bound.cwiseMax(PETSC_NINFINITY);
  ok(VecSet(high, PETSC_INFINITY));
  Quadratic context{problem.k(), correction.rhs};
  Handle<Tao, TaoDestroy> solver;
  ok(TaoCreate(PETSC_COMM_WORLD, &solver));
  ok(TaoSetType(solver, method == TaoMethod::bnls ? TAOBNLS : TAOBNTR));
  ok(TaoSetSolution(solver, v));
  ok(TaoSetObjectiveAndGradient(solver, nullptr, energy, &context));
  ok(TaoSetHessian(solver, problem.k(), problem.k(), hessian, &context));
  ok(TaoSetVariableBounds(solver, low, high));
  KSP inner = nullptr;
  PC multigrid = nullptr;
  ok(TaoGetKSP(solver, &inner));
  ok(KSPGetPC(inner, &multigrid));
  ok(PCSetType(multigrid, PCHYPRE));
  ok(PCHYPRESetType(multigrid, "boomeramg"));
  if (split) ok(TaoSetTolerances(solver, 1e-12 * correction.load, 0, 1e-6));
  ok(TaoSetMaximumIterations(solver, 200));
  ok(TaoSetFromOptions(solver));
  ok(TaoSolve(solver));
  TaoConvergedReason reason = TAO_CONTINUE_ITERATING;
  PetscInt newton = 0;
  PetscInt linear = 0;
  ok(TaoGetConvergedReason(solver, &reason));
  ok(TaoGetIterationNumber(solver, &newton));
  ok(TaoGetLinearSolveIterations(solver, &linear));
  end.reason = TaoConvergedReasons[reason];
  if (end.reason.empty()) end.reason = fmt::format("REASON_{}", static_cast<int>(reason));
  end.converged = reason > 0;
  end.newton += static_cast<int>(newton);
  end.linear += static_cast<int>(linear);
  return v;
}

}  // namespace

PetscEnd tao(const DistributedProblem& problem, State& state, TaoMethod method, bool split) {
  return bounded_corrections(problem, state, split,
                             [&](const BoundedCorrection& correction, PetscEnd& end) {
                               return solved(problem, correction, method, split, end);
                             });
}

}  // namespace antilock::distributed
