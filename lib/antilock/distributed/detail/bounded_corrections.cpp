#include "antilock/distributed/detail/bounded_corrections.hpp"

#include <algorithm>
#include <cmath>

#include "antilock/distributed/ranks.hpp"

namespace antilock::distributed {

PetscEnd bounded_corrections(const DistributedProblem& problem, State& state, bool split,
                             const CorrectionSolver& solve) {
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
  PetscEnd end;
  for (bool settled = false; !settled && end.converged && end.corrections < max_corrections;
       ++end.corrections) {
    const Eigen::VectorXd r2 = problem.compatibility(state.u, state.p);
    rows.summed(problem.right_side(problem.equilibrium(state.u, state.p), r2), rhs);
    const Eigen::VectorXd bound = problem.lower() - Entries(u);
    const Vector du = solve({rhs, bound, load}, end);
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
