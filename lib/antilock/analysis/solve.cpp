#include "antilock/analysis/solve.hpp"

#include <utility>

#include "antilock/analysis/locking_report.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/models/anti_plane.hpp"

namespace antilock {

Result solve(const Scene& scene, const Space& space, const ActiveSetOptions& options) {
  return solve(scene, space,
               [&](const VariationalInequality& problem) { return active_set(problem, options); });
}

Result solve(const Scene& scene, const Space& space, const Solver& solver) {
  if (space.free_count() == 0)
    throw Error("solve: every unknown is fixed, none is left to solve for; accepted: a finer mesh");
  Stopwatch watch;
  Result result{.space = space, .problem = assemble(scene, space)};
  result.seconds.assemble = watch.lap();
  result.solution = solver(result.problem);
  add_locking_report(result, report_locking(scene, result));
  const SolveSeconds& spent = result.solution.seconds;
  result.seconds.factor = spent.analyse + spent.factor;
  result.seconds.solve = watch.lap() - result.seconds.factor;
  return result;
}

}  // namespace antilock
