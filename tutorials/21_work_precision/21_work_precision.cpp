// # What accuracy costs in time
//
// Run: 21_work_precision                         h from 1/8 to 1/64; half a minute
// Run: 21_work_precision --cells 256 --limit 4   h down to 1/256; minutes (figures/benchmark does this)
// Run: 21_work_precision --freefem freefem/run   FreeFEM's active set beside them, the stiff part summed as it comes
// Run: 21_work_precision --exercise 1
//
// Needs: [34](../34_solving_the_inequality/34_solving_the_inequality.cpp) for Uzawa and its
// steps, [09](../09_convergence/09_convergence.cpp) for orders,
// [18](../18_roundoff/18_roundoff.cpp) for CG + ILUT,
// [19](../19_certificate/19_certificate.cpp) for the energy bracket.
//
// **The picture.** Error against wall seconds at ε = 1e-6; a good method is a line that
// falls steeply, far to the left. *P1 on the unstructured mesh is a level line: it has
// locked, and no time buys accuracy.*
//
// **Predict.** (a) The active set starts from the contact set of the mesh that is twice as
// coarse. Halve $h$: by what factor do its linear solves grow, and the steps of Uzawa? (b)
// Uzawa's algebraic error $|u_k - u_h|$ falls by a constant factor per step, for ever. Does
// the error of the solution, $|u_k - u|$?
//
// ## What is measured
//
// A method is an element, a kind of mesh and a solver. Three solvers of (23): the
// primal-dual active set on $Γ_C$, Uzawa with a Cholesky factor, and Uzawa as the paper ran
// it, with conjugate gradients and ILUT. Each point is the median of five runs, without
// mesh and assembly. A run that fails, or takes longer than the limit, is drawn as failed;
// where time was the reason, finer meshes are not tried. No verdict is about seconds: they
// depend on the machine.
// [Chapter 34](../34_solving_the_inequality/34_solving_the_inequality.cpp) has the steps
// and the seconds of further solvers, and a price list of its own, which the benchmark
// appends to that of this chapter.
//
// ## How many steps
//
// The active set guesses which points touch; from the contact set of a coarser mesh the
// guess is nearly right. Uzawa moves pressures instead. The operator behind it is
// the *compliance* of $Γ_C$: pressure in, displacement out. With the best step the error
// falls by $(κ - 1)/(κ + 1)$ per step, $κ$ the condition number of the compliance, so that
// an error of $tol$ takes about $(κ/2) \ln(1/tol)$ steps (chapter 34).
//
// How large is $κ$? Chapter 04 has the stiffness of $Γ_C$ against a pressure $\sin kπx$:
// about $kπ$ at ε = 1, where the answer goes into the depth only as far as a half wave is
// long, and about $(kπ)^2$ for a rigid layer, which resists like a string. A mesh carries
// $k = 1$ to about $1/h$. Hence $κ ∼ 1/h$ at ε = 1, and $κ ∼ 1/h^2$ as ε → 0.
//
// ## When to stop
//
// By the triangle inequality $|u_k - u| ≤ |u_k - u_h| + |u_h - u|$, and only the first term
// falls with the steps $k$. Once it is below the second, more steps do not bring $u_k$
// nearer to $u$. Neither is known, since neither $u$ nor $u_h$ is; two computable numbers
// stand for them.
//
// *The duality gap* stands for the first. On one side, $J(v)$ is above $J(u_h)$ for each
// $v$ in $K_h$. On the other, take a pressure $μ ≥ 0$: the smallest value of $J(v) - μ v$
// over all $v$, the *dual energy* of $μ$, is below $J(u_h)$, since $μ u_h ≥ 0$. Take for
// $v$ the iterate pushed out of the obstacle, for $μ$ its pressure. Then
//
// $$ J(v) - \text{dual energy of } μ ≥ J(v) - J(u_h) ≥ ½ |v - u_h|_a^2   (proved). $$
//
// *The energy bracket* of [chapter 19](../19_certificate/19_certificate.cpp) stands for the
// second: it holds $J(u)$, and its width is of order $h^2$. A mesh twice as coarse gives it
// at a quarter of the price. Its width is then divided by 4. This is an extrapolation: the
// order is observed, and where a method locks it is wrong.
//
// *The rule.* Let $b$ be the width over $|J|$. The energy error of $u_h$ is of relative
// order $b^{1/2}$, because half its square is at most the width. So $b$ is like $h^2$, and
// where $u$ is smooth the largest error of $u_h$ is of this order, too. Uzawa stops when
// the duality gap is at most $(b/20)^2 |J|$. Then $|v - u_h|_a$ is at most $b/20$ of
// $|u_h|_a$, because $|J(u_h)| = ½ |u_h|_a^2$ and $J$ is nearly $J(u_h)$. The 20 is a
// safety factor: the algebraic error is to be small against the *largest* error too, not
// only against that of the energy.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "antilock/certificate/balanced_tolerance.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/mesh/families.hpp"
#include "antilock/solve/summed.hpp"
#include "course/median_seconds.hpp"
#include "support.hpp"

using namespace antilock;
using tutorial::Exact, tutorial::TimedRun;

// **Work and precision**: every solver at every ε, for one method on one mesh.
void add(tutorial::Timing& study, const Method& method,
         const std::shared_ptr<const TriangleMesh>& mesh, TimedRun run,
         const std::vector<Exact>& exact_solution) {
  run.element = method.element->name();
  run.mesh = method.family.name;
  // ### Forms
  const Space space(mesh, *method.element);
  for (const Exact& exact : exact_solution) {
    const VariationalInequality problem =
        assemble(tutorial::paper_scene(exact.epsilon), space);
    run.epsilon = exact.epsilon;
    run.unknowns = problem.free_count();
    // ### Solve
    UzawaOptions options;
    options.max_seconds = study.limit;
    const auto errors = [&](const Solution& u_h) { return exact.errors(space, u_h); };
    const auto at_once = [&] { return active_set(problem); };
    study.add(run, "active set", at_once, errors,
              false);  // no limit: no verdict may hang on the machine
    study.add(
        run, "Uzawa, Cholesky", [&] { return uzawa(problem, options); }, errors);
    study.add(
        run, "Uzawa, CG + ILUT", [&] { return uzawa_cg_ilut(problem, options); }, errors);
    tutorial::add_freefem(study, run, space, exact.table);
  }
}

// **How many steps**: Uzawa to 12 digits, the tolerance 1e-12 on the step in the gap.
Table count_steps(int finest) {
  Table steps({"epsilon", "h", "steps"});
  for (const double epsilon : {1.0, 1e-6})
    for (int n = 16; n <= finest; n *= 2) {
      const Space space(structured_mesh(n), p1());
      UzawaOptions options;
      options.tolerance = 1e-12;
      steps.add({epsilon, 1.0 / n,
                 uzawa(assemble(tutorial::paper_scene(epsilon), space), options)
                     .counters.contact_iterations});
    }
  return steps;
}

// **Stop when it is accurate enough**: Uzawa's two errors step by step, and where the
// bracket stops it.
Table stop_early(const Method& method, int cells, const Exact& exact,
                 tutorial::Report& report) {
  const Scene scene = tutorial::paper_scene(exact.epsilon);
  const Space space = method.space(cells);
  const VariationalInequality problem = assemble(scene, space);
  const auto error = [&](const Solution& u_h) { return exact.errors(space, u_h).max; };
  UzawaOptions options;
  const EnergyBounds coarse = energy_bounds(scene, method.mesh(cells / 2)),
                     own = energy_bounds(scene, space.mesh());
  options.stop_at = balanced_tolerance(coarse, 2);
  const double extrapolated = options.stop_at->relative / balanced_tolerance(own).relative;
  const Solution full = uzawa(problem), early = uzawa(problem, options);
  const double of_full = error(full), of_early = error(early);
  report.claim(of_early < 1.01 * of_full &&
                   2 * early.counters.contact_iterations < full.counters.contact_iterations,
               "{}, accurate enough: Uzawa stops after {} steps, not {}, at {:.4f} of the "
               "error (observed)",
               method.name(), early.counters.contact_iterations,
               full.counters.contact_iterations, of_early / of_full);
  if (method.family.name ==
      "structured")  // elsewhere P1, the upper end of the bracket, may lock
    report.claim_within(
        extrapolated, 0.9, 1.1,
        "a quarter of the coarse bracket's width over the mesh's own (observed)");
  return tutorial::uzawa_on_its_way(method.name(), problem, early, full, error);
}

// **The price of order two**: Crouzeix-Raviart and the hybrid form of BDM1
// ([chapter 38](../38_order_two/38_order_two.cpp)) on rows of triangles without columns.
// $h$ is halved until the energy error is 0.3 % of $|u|_a = (-2 J(u))^{1/2}$.
Table order_two(int repeats, int finest, const std::vector<Exact>& exact_solution) {
  Table runs({"element", "epsilon", "cells", "unknowns", "relative", "seconds"});
  for (const Element* element : {&crouzeix_raviart(), &hybrid_bdm1()})
    for (const Exact& exact : exact_solution) {
      const double size = std::sqrt(-2 * exact.solution.energy());
      double relative = 1;
      for (int n = 4; n <= finest && relative > 0.003; n *= 2) {
        const Space space(mesh_family("rows").mesh(n), *element);
        const VariationalInequality problem =
            assemble(tutorial::paper_scene(exact.epsilon), space);
        Solution u_h;
        const double seconds =
            tutorial::median_seconds(repeats, [&] { u_h = active_set(problem); });
        relative = exact.errors(space, u_h).energy / size;
        runs.add(
            {element->name(), exact.epsilon, n, problem.free_count(), relative, seconds});
      }
    }
  return runs;
}

void judge_order_two(const Table& runs, int cells, tutorial::Report& report) {
  if (cells < 64)
    return report.not_judged("price of order two: CR needs 1/h = 64 to come near 3 %");
  bool reached = true;
  double hybrid_unknowns = 0;  // the most over epsilon, to 0.3 %
  double cr_unknowns = std::numeric_limits<double>::infinity();  // the fewest, to 3 %
  for (const TableEntry& epsilon : runs.unique("epsilon")) {
    const Table here = runs.filter("epsilon", epsilon);
    const Table hybrid = here.filter("element", "BDM1-hybrid");
    const Table cr = here.filter("element", "CR");
    const Table enough = cr.filter_number("relative", [](double e) { return e <= 0.03; });
    reached = reached && hybrid.last("relative") <= 0.003;
    hybrid_unknowns = std::max(hybrid_unknowns, hybrid.last("unknowns"));
    cr_unknowns = std::min(
        cr_unknowns, (enough.size() > 0 ? enough.first("unknowns") : cr.last("unknowns")));
  }
  report.claim(
      reached && hybrid_unknowns < cr_unknowns,
      "without columns, h halved: hybrid BDM1 has an energy error of 0.3 % at each "
      "epsilon with at most {} unknowns, and CR has none of 3 % with fewer than {} "
      "(observed)",
      hybrid_unknowns, cr_unknowns);
}

void judge_runs(const tutorial::Timing& study, double ridge, tutorial::Report& report) {
  bool reliable = true;
  double reference = 0, apart = 0, locked = 0, free = 0;
  for (const TimedRun& r : study.runs) {
    reliable = reliable && (r.ok || r.solver != "active set");
    if (r.solver == "active set")
      reference = r.errors.max;  // the first solver of each problem
    if (r.solver == "Uzawa, Cholesky" && r.ok)
      apart = std::max(apart, std::abs(r.errors.max - reference) / r.scale);
    if (r.solver == "active set" && r.mesh == "unstructured" &&
        r.epsilon == 1e-6)  // the finest mesh comes last
      (r.element == "P1" ? locked : free) = r.errors.max_at_unknowns / ridge;
  }
  report.claim(reliable,
               "the active set answers on every mesh and at every epsilon (observed)");
  // Uzawa ends where a step moves less than 1e-10 of u in the gap, which is its error on
  // Gamma_C.
  report.claim(apart <= 2e-10,
               "where Uzawa ends within its limit, its error is that of the active set to "
               "{:.0e} of u (observed)",
               apart);
  report.claim_within(locked, 0.98, 1.01,
                      fmt::format("epsilon = 1e-6, unstructured: Crouzeix-Raviart misses "
                                  "{:.3f} of the ridge; no time buys "
                                  "accuracy from P1, which misses (observed)",
                                  free));
}

void work_precision(const tutorial::Options& options, tutorial::Report& report,
                    tutorial::Timing study) {
  const std::vector<Exact> exact_solution = tutorial::exact_solutions({1, 1e-2, 1e-6});
  for (int n = 8; n <= options.cells; n *= 2)
    for (const MeshFamily& family : {structured(), unstructured()}) {
      // ### Mesh
      report.stage(fmt::format("1/h = {}, {}", n, family.name));
      const Stopwatch watch;
      const auto mesh = std::make_shared<const TriangleMesh>(family.mesh(n));
      const TimedRun run{.cells = n, .mesh_seconds = watch.seconds()};
      for (const Element* element : {&p1(), &crouzeix_raviart()})
        add(study, {element, family}, mesh, run, exact_solution);
    }
  report.stage("price of order two");
  const Table second = order_two(study.repeats, options.cells, exact_solution);
  // ### Output
  report.stage("where the time goes");
  tutorial::write_stages(options.out, std::max(128, options.cells), study.repeats);
  tutorial::write_runs(options.out / "work_precision.csv", study.runs);
  tutorial::write_price_list(options.out, study.runs);
  tutorial::write_order_two(options.out, second, study.repeats);
  tutorial::write_machine(options.out / "machine.csv");
  judge_runs(study, exact_solution.back().solution.max_on_contact(), report);
  const Table steps = count_steps(std::min(2 * options.cells, 128));
  steps.pivot("h", "epsilon", "steps")
      .print("Uzawa's steps to 12 digits, by h and epsilon", 6);
  steps.write(options.out / "steps.csv");
  // κ ∼ h^-1 and h^-2. The logarithm takes up to 0.4 off the second: the slowest wave is as
  // long as a cell, and its share of the error falls itself, like h^(7/2), so that fewer
  // digits of it are left to gain. A finer mesh may take one correction more, whose steps
  // count too: 0.1.
  report.claim_orders(steps.filter("epsilon", 1.0), "steps", -1.2, -0.75,
                      "Uzawa at epsilon = 1: steps");
  report.claim_orders(steps.filter("epsilon", 1e-6), "steps", -2.1, -1.6,
                      "Uzawa at epsilon = 1e-6: steps");
  Table stopping({"method", "quantity", "steps", "error"});
  const Exact& exact = exact_solution[1];              // ε = 1e-2
  const int most_cells = std::min(options.cells, 64);  // finer, the last steps are minutes
  for (const Method& method : methods())
    if (method.name() != "CR structured")
      stopping.add(stop_early(method, most_cells, exact, report));
  stopping.write(options.out / "stopping.csv");
  judge_order_two(second, options.cells, report);
}

// ## What came out
//
// (a) The linear solves of the active set do not grow. It needs at most 4 contact steps, on
// fine meshes 1 or 2, since it starts from the contact set of a coarser one. Uzawa's steps
// grow by the factor 2 at ε = 1 and by almost 4 at 1e-6 each time $h$ is halved.
// :output: Uzawa's steps to 12 digits
// :figure: uzawa_steps
//
// At ε = 1e-6 the last mesh, 1/h = 128, takes some 103 thousand steps. With four times as
// many on the next one, 1/h = 256, they are some 410 thousand (extrapolated). With the
// paper's linear solver, conjugate gradients with ILUT, Uzawa gives up at small ε.
// :number: 103 = 1e-3 * table "Uzawa's steps" 1e-06 h=0.0078125
//
// (b) No: it comes to a level line. The bracket stops Uzawa there, after less than half of
// the steps, within 1 % of the error. On columns a quarter of the coarse bracket's width is
// that of the mesh's own, to 1 %. `price_list.md` says what 1e-2, 1e-3 and 1e-4 cost, or
// "never".
//
// *What does the order change?* The errors of Crouzeix-Raviart in the energy norm are like
// $h$, so that a digit costs 100 times the unknowns. With order 2 it would cost 10 times.
// The hybrid form of BDM1 has this order without contact, and one above 1 in contact
// ([chapter 38](../38_order_two/38_order_two.cpp)). It has 2.7 times the unknowns of CR on
// the same mesh. `order_two.md` has the seconds of both for 10, 3, 1 and 0.3 %.
// :figure: stopping
// :figure: stages
//
// ## Exercises
//
// 1. P1 structured at ε = 1e-2: how do the contact steps of the active set grow from 1/h =
//    8 to 64, and those of Uzawa?
// 2. On paper: errors are like $h^2$, seconds like $N = h^{-2}$. What does a digit cost?
//    And with errors like $h$?
//
// ## Further reading
//
// - [Glowinski 1984](../guides/bibliography.md#glowinski-1984): Uzawa's method and its
//   step.
// - [Hintermüller, Ito and Kunisch 2002](../guides/bibliography.md#hintermueller-2002): why
//   the active set needs few steps from a good start.

#include "answers.hpp"

int main(int argc, char** argv) {
  tutorial::Timing study;
  const auto add_options = [&](CLI::App& line) {
    line.add_option("--limit", study.limit, "seconds after which a run counts as failed")
        ->check(CLI::Range(1e-3, 3600.0));
    line.add_option("--repeats", study.repeats,
                    "runs of each solver; their median is its time")
        ->check(CLI::Range(1, 99));
    line.add_option("--freefem", study.freefem,
                    "the command freefem/run, to measure FreeFEM's script too");
  };
  return tutorial::run(argc, argv, "21_work_precision", "What accuracy costs in time",
                       {.takes_epsilon = false,
                        .cells = 64,
                        .least_cells = 16,
                        .add = add_options,
                        .exercises = exercises},
                       [&](const tutorial::Options& o, tutorial::Report& r) {
                         study.out = o.out;
                         work_precision(o, r, study);
                       });
}
