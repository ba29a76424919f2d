// # What accuracy costs in time
//
// Run: 18_work_precision                         h from 1/8 to 1/64; half a minute
// Run: 18_work_precision --cells 256 --limit 4   h down to 1/256; minutes (figures/benchmark does this)
// Run: 18_work_precision --freefem freefem/run   FreeFEM's active set beside them, the stiff part summed as it comes
// Run: 18_work_precision --exercise 1
//
// Needs: [04](04_reference_solution.cpp) for Uzawa and its steps, [09](09_convergence.cpp) for orders,
// [16](16_roundoff.cpp) for CG + ILUT, [17](17_certificate.cpp) for the energy bracket.
//
// **The picture.** Error against wall seconds at ε = 1e-6; a good method is a line that falls steeply, far to the
// left. *P1 on the unstructured mesh is a level line: it has locked, and no time buys accuracy.*
//
// **Predict.** (a) Halve $h$: by what factor do the linear solves of the active set grow, and the steps of Uzawa? (b)
// Uzawa's algebraic error $|u_k - u_h|$ falls by a constant factor per step, for ever. Does the error of the
// solution, $|u_k - u|$?
//
// ## What is measured
//
// A method is an element, a kind of mesh and a solver. Three solvers of (23): the primal-dual active set on $Γ_C$,
// Uzawa with a Cholesky factor, and Uzawa as the paper ran it, with conjugate gradients and ILUT. Each point is the
// median of five runs, mesh and assembly apart. A run that fails, or takes longer than the limit, is drawn as failed;
// where time was the reason, finer meshes are not tried. No verdict is about seconds, which depend on the machine.
//
// ## When to stop
//
// By the triangle inequality $|u_k - u| ≤ |u_k - u_h| + |u_h - u|$, and only the first term falls with the steps $k$.
// Once it is below the second, more steps do not bring $u_k$ nearer to $u$. Neither is known, since neither $u$ nor
// $u_h$ is; two computable numbers stand for them.
//
// *The duality gap* stands for the first. $J(v)$ is above $J(u_h)$ for each $v$ in $K_h$. For each pressure $μ ≥ 0$
// the smallest value of $J(v) - μ v$ over all $v$, the *dual energy* of $μ$, is below $J(u_h)$, since $μ u_h ≥ 0$.
// Take for $v$ the iterate pushed out of the obstacle, for $μ$ its pressure: this is at least $½ |v - u_h|_a^2$.
//
// *The energy bracket* of [chapter 17](17_certificate.cpp) stands for the second: it holds $J(u)$, its width is of
// order $h^2$, and a mesh twice as coarse gives it at a quarter of the price; its width is then divided by 4.
//
// *The rule.* Let $b$ be the width over $|J|$. The largest error of $u_h$ is of relative order $b$, its energy error of
// order $b^{1/2}$. Uzawa stops when the duality gap is at most $(b/20)^2 |J|$. Then $|v - u_h|_a$ is at most
// $b/20$ of $|u_h|_a$ (`analysis/accurate_enough.hpp`).

#include "antilock/analysis/accurate_enough.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/solve/exhibits/uzawa_cg_ilut.hpp"
#include "antilock/solve/uzawa.hpp"
#include "common/course.hpp"
#include "common/stopped_early.hpp"
#include "common/timed_runs.hpp"

using namespace antilock;
using tutorial::Exact, tutorial::TimedRun;

// **Work and precision**: every solver at every ε, for one method on one mesh.
void add(tutorial::Timing& study, const Method& method, const TriangleMesh& mesh, TimedRun run,
         const std::vector<Exact>& truth) {
  run.element = method.element->name();
  run.mesh = method.family.name;
  // ### Forms
  const Space space = method.space(mesh);
  for (const Exact& exact : truth) {
    const VariationalInequality problem = assemble(tutorial::paper_scene(exact.epsilon), space);
    run.epsilon = exact.epsilon;
    run.unknowns = problem.free_count();
    // ### Solve
    UzawaOptions options;
    options.max_seconds = study.limit;
    const auto errors = [&](const Solution& u_h) { return exact.errors(space, u_h); };
    const auto at_once = [&] { return active_set(problem); };
    study.add(run, "active set", at_once, errors, false);  // no limit: no verdict may hang on the machine
    study.add(
        run, "Uzawa, Cholesky", [&] { return uzawa(problem, options); }, errors);
    study.add(
        run, "Uzawa, CG + ILUT", [&] { return uzawa_cg_ilut(problem, options); }, errors);
    study.add_freefem(run, space, exact.table);
  }
}

// **Stop when it is accurate enough**: Uzawa's two errors step by step, and where the bracket stops it.
Table stop_early(const Method& method, int cells, const Exact& exact, tutorial::Report& report) {
  const Scene scene = tutorial::paper_scene(exact.epsilon);
  const Discretisation on = method.on(cells);
  const VariationalInequality problem = assemble(scene, on.space());
  const auto error = [&](const Solution& u_h) { return exact.errors(on.space(), u_h).max; };
  UzawaOptions options;
  options.enough = accurate_enough(energy_bracket(scene, method.mesh(cells / 2)), 2);
  const Solution full = uzawa(problem), early = uzawa(problem, options);
  const double of_full = error(full), of_early = error(early);
  report.claim(of_early < 1.01 * of_full && 2 * early.counters.contact < full.counters.contact,
               "{}, accurate enough: Uzawa stops after {} steps, not {}, at {:.4f} of the error", method.name(),
               early.counters.contact, full.counters.contact, of_early / of_full);
  return tutorial::uzawa_on_its_way(method.name(), problem, early, full, error);
}

void work_precision(const tutorial::Options& options, tutorial::Report& report, tutorial::Timing study) {
  const std::vector<Exact> truth = tutorial::exact_solutions({1, 1e-2, 1e-6});
  for (int n = 8; n <= options.cells; n *= 2)
    for (const MeshFamily& family : {structured(), unstructured()}) {
      // ### Mesh
      report.stage(fmt::format("1/h = {}, {}", n, family.name));
      const Stopwatch watch;
      const TriangleMesh mesh = family.mesh(n);
      const TimedRun run{.cells = n, .mesh_seconds = watch.seconds()};
      for (const Element* element : {&p1(), &crouzeix_raviart()}) add(study, {element, family}, mesh, run, truth);
    }
  // ### Output
  report.stage("where the time goes");
  study.write(options.cells);
  study.judge(report);
  const double locked = study.finest({&p1(), unstructured()}, 1e-6).relative(),
               free = study.finest({&crouzeix_raviart(), unstructured()}, 1e-6).relative();
  report.claim(locked > 5 * free,
               "no time buys accuracy from P1 on the unstructured mesh at epsilon = 1e-6: {:.1e} relative, "
               "Crouzeix-Raviart {:.1e}",
               locked, free);
  Table stopping({"method", "quantity", "steps", "error"});
  const Exact& exact = truth[1];                       // ε = 1e-2
  const int most_cells = std::min(options.cells, 64);  // finer, the last steps are minutes
  for (const Method& method : methods())
    if (method.name() != "CR structured") stopping.add(stop_early(method, most_cells, exact, report));
  stopping.write(options.out / "stopping.csv");
}

// ## What came out
//
// (a) The linear solves of the active set do not grow. It needs at most 4 contact steps, on fine meshes 1 or 2, since
// it starts from the contact set of a coarser one. Uzawa's steps grow with the condition number of the compliance of
// $Γ_C$: each time $h$ is halved, by the factor 2 at ε = 1 and by almost 4 at 1e-6 (chapter 04). With the paper's
// linear solver Uzawa gives up at small ε. (b) No: it comes to a level line. The bracket stops Uzawa there, after less
// than half of the steps, within 1 % of the error. `price_list.md` says what 1e-2, 1e-3 and 1e-4 cost, or "never".
//
// ## Exercises
//
// 1. P1 structured at ε = 1e-2: how do the contact steps of the active set grow from 1/h = 8 to 64, and those of Uzawa?
// 2. On paper: errors are like $h^2$, seconds like $N = h^{-2}$. What does a digit cost? And with errors like $h$?

#include "answers/18_work_precision.hpp"

int main(int argc, char** argv) {
  tutorial::Timing study;
  const auto add_options = [&](tutorial::CommandLine& line) {
    line.add("--limit", study.limit, "seconds after which a run counts as failed", 1e-3, 3600);
    line.add("--repeats", study.repeats, "runs of each solver; their median is its time", 1, 99);
    line.add("--freefem", study.freefem, "the command freefem/run, to measure FreeFEM's script too");
  };
  return tutorial::run(
      argc, argv, "18_work_precision", "What accuracy costs in time",
      {.takes_epsilon = false, .cells = 64, .least_cells = 16, .add = add_options, .exercises = exercises},
      [&](const tutorial::Options& o, tutorial::Report& r) {
        study.out = o.out;
        work_precision(o, r, study);
      });
}
