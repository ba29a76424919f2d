#include "antilock/distributed/detail/snesvi.hpp"

#include <petscsnes.h>

#include <cmath>

#include "antilock/distributed/ranks.hpp"

namespace antilock::distributed {
namespace {

using NewtonSolver = Handle<SNES, SNESDestroy>;

struct Linear {
  Mat k;
  Vec rhs;
};

PetscErrorCode residual(SNES, Vec u, Vec r, void* context) {  // r = K u - rhs
  const auto* problem = static_cast<const Linear*>(context);
  PetscErrorCode code = MatMult(problem->k, u, r);
  return code != 0 ? code : VecAXPY(r, -1, problem->rhs);
}

PetscErrorCode jacobian(SNES, Vec, Mat, Mat, void*) { return 0; }  // K itself, which does not change

double largest_on_contact(const Inequality& problem, Vec u) {
  double most = 0;
  const PetscScalar* values = nullptr;
  ok(VecGetArrayRead(u, &values));
  for (int i = 0; i < problem.rows().owned(); ++i)
    if (!std::isinf(problem.lower()(i))) most = std::max(most, values[i]);
  ok(VecRestoreArrayRead(u, &values));
  return largest(most);
}

/// SNESVI on v >= bound, K v = rhs off the contact set.
class Newton {
 public:
  explicit Newton(const Inequality& problem) {
    // without room for ghosts: SNESVI takes its vectors apart
    const auto make = [&](Vector& v) { ok(MatCreateVecs(problem.k(), &v, nullptr)); };
    make(v_), make(r_), make(bound_), make(upper_), make(rhs_);
    ok(VecSet(upper_, PETSC_INFINITY));
    context_ = {problem.k(), rhs_};
    ok(SNESCreate(PETSC_COMM_WORLD, &solver_)), ok(SNESSetType(solver_, SNESVINEWTONRSLS));
    ok(SNESSetFunction(solver_, r_, residual, &context_));
    ok(SNESSetJacobian(solver_, problem.k(), problem.k(), jacobian, nullptr));
  }
  SNES solver() const { return solver_; }

  /// From v = 0. `bound` per owned row. Returns v; counts in `end`.
  Vec solve(Vec rhs, const Eigen::VectorXd& bound, SnesviEnd& end) {
    ok(VecCopy(rhs, rhs_)), ok(VecSet(v_, 0));
    PetscScalar* values = nullptr;
    ok(VecGetArray(bound_, &values));
    for (Eigen::Index i = 0; i < bound.size(); ++i) values[i] = std::isinf(bound(i)) ? PETSC_NINFINITY : bound(i);
    ok(VecRestoreArray(bound_, &values));
    ok(SNESVISetVariableBounds(solver_, bound_, upper_)), ok(SNESSetFromOptions(solver_));
    ok(SNESSolve(solver_, nullptr, v_));
    SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
    PetscInt newton = 0, linear = 0;
    ok(SNESGetConvergedReason(solver_, &reason)), ok(SNESGetIterationNumber(solver_, &newton));
    ok(SNESGetLinearSolveIterations(solver_, &linear));
    end.reason = SNESConvergedReasons[reason], end.converged = reason > 0;
    end.newton += static_cast<int>(newton), end.linear += static_cast<int>(linear);
    return v_;
  }

 private:
  Vector v_, r_, bound_, upper_, rhs_;
  Linear context_{};
  NewtonSolver solver_;
};

}  // namespace

SnesviEnd snesvi(const Inequality& problem, int most_steps) {
  Newton newton(problem);
  ok(SNESSetTolerances(newton.solver(), PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, most_steps, PETSC_DEFAULT));
  const Vector load = problem.rows().vector();
  problem.rows().summed(problem.part().load, load);
  SnesviEnd end{"", false};
  end.largest = largest_on_contact(problem, newton.solve(load, problem.lower(), end));
  return end;
}

SnesviEnd snesvi_split(const Inequality& problem, State& state, double tolerance) {
  constexpr int most_corrections = 20;
  const Rows& rows = problem.rows();
  const Eigen::VectorXd& m = problem.part().m;
  const Vector u = rows.vector(), rhs = rows.vector(), du = rows.vector();
  rows.owned_part(state.u, u);
  PetscReal load = 0, moved = 0, size = 0;
  rows.summed(problem.part().load, rhs), ok(VecNorm(rhs, NORM_2, &load));
  SnesviEnd end{"", false};
  for (end.corrections = 0; end.corrections < most_corrections;) {
    const Eigen::VectorXd r2 = problem.compatibility(state.u, state.p);
    const Eigen::VectorXd weighted = m.size() > 0 ? Eigen::VectorXd(m.cwiseProduct(r2) / problem.delta()) : r2;
    rows.summed(problem.equilibrium(state.u, state.p) + problem.part().b.transpose() * weighted, rhs);
    Eigen::VectorXd bound = problem.lower();
    for (int place = 0; place < rows.owned(); ++place) bound(place) -= state.u(rows.unknown(place));
    Newton newton(problem);  // anew: PETSc keeps the sizes of the last contact set
    SNESLineSearch search = nullptr;
    ok(SNESGetLineSearch(newton.solver(), &search)), ok(SNESLineSearchSetType(search, SNESLINESEARCHBASIC));
    ok(SNESSetTolerances(newton.solver(), 1e-12 * load, 1e-6, 0, 200, PETSC_DEFAULT));
    ok(VecCopy(newton.solve(rhs, bound, end), du));
    ++end.corrections;
    ok(VecAXPY(u, 1, du)), ok(VecNorm(du, NORM_INFINITY, &moved)), ok(VecNorm(u, NORM_INFINITY, &size));
    const Eigen::VectorXd step = rows.local(du);
    state.u += step;
    if (m.size() > 0) state.p += (problem.part().b * step - r2) / problem.delta();
    if (!end.converged || moved <= tolerance * size) break;
  }
  for (int place = 0; place < rows.owned(); ++place)
    state.active[place] = state.u(rows.unknown(place)) <= problem.lower()(place) + 1e-14 * size ? 1 : 0;
  end.converged = end.converged && moved <= tolerance * size;
  end.largest = largest_on_contact(problem, u);
  return end;
}

}  // namespace antilock::distributed
