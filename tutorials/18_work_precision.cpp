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
// By the triangle inequality
//
// $$ |u_k - u| ≤ |u_k - u_h| + |u_h - u|, $$
//
// and only the first term falls with the steps $k$. Once it is below the second, more steps do not bring $u_k$ nearer
// to $u$. Neither is known, since neither $u$ nor $u_h$ is; two computable numbers stand for them.
//
// *The duality gap* stands for the first. $J(v)$ is above $J(u_h)$ for each $v$ in $K_h$. For each pressure $μ ≥ 0$
// the smallest value of $J(v) - μ v$ over all $v$, the *dual energy* of $μ$, is below $J(u_h)$, since $μ u_h ≥ 0$.
// Take for $v$ the iterate $u_k$ pushed out of the obstacle, for $μ$ its pressure: the difference is at least
// $½ |v - u_h|_a^2$.
//
// *The energy bracket* of [chapter 17](17_certificate.cpp) stands for the second: it holds $J(u)$, its width is of
// order $h^2$, and a mesh twice as coarse gives it at a quarter of the price; its width is then divided by 4.
//
// *The rule.* Let $b$ be the width over $|J|$. The largest error of $u_h$ is of relative order $b$, its energy error of
// order $b^{1/2}$. Uzawa stops when the duality gap is at most $(b/20)^2 |J|$. Then $|v - u_h|_a$ is at most
// $b/20$ of $|u_h|_a$ (`analysis/accurate_enough.hpp`).
//
// The load $f = 10 \sin 2πx$ is chosen here. The paper gives none.

#include <limits>

#include "antilock/analysis/accurate_enough.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/exhibits/uzawa_cg_ilut.hpp"
#include "antilock/solve/uzawa.hpp"
#include "antilock/study/method.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/timed_runs.hpp"
#include "common/tutorial.hpp"

using namespace antilock;
using tutorial::Exact;
using tutorial::TimedRun;

constexpr int repeats = 5;

struct Study {
  double limit;         // seconds
  std::string freefem;  // the command freefem/run, or nothing
  std::filesystem::path out;
  std::vector<Exact> exact{};  // one per epsilon
  std::vector<TimedRun> runs{};
};

// **Work and precision**: every solver at every ε, for one method on one mesh.
void add(Study& study, const Method& method, const TriangleMesh& mesh, int cells, double mesh_seconds) {
  // ### Forms
  const Space space = method.space(mesh);
  for (const Exact& exact : study.exact) {
    const VariationalInequality problem = assemble(tutorial::paper_scene(exact.epsilon), space);
    // ### Solve
    UzawaOptions options;
    options.max_seconds = study.limit;
    const std::vector<std::pair<std::string, std::function<Solution()>>> solvers{
        {"active set", [&] { return active_set(problem); }},
        {"Uzawa, Cholesky", [&] { return uzawa(problem, options); }},
        {"Uzawa, CG + ILUT", [&] { return uzawa_cg_ilut(problem, options); }}};
    const auto start = [&](const std::string& solver) {
      TimedRun run{.element = method.element->name(), .mesh = method.family.name, .solver = solver};
      run.epsilon = exact.epsilon;
      run.cells = cells;
      run.unknowns = problem.free_count();
      run.mesh_seconds = mesh_seconds;
      return run;
    };
    for (const auto& [name, solve] : solvers) {
      TimedRun run = start(name);
      // the active set without a limit: no verdict may hang on the machine
      const double limit = name == "active set" ? std::numeric_limits<double>::infinity() : study.limit;
      if (!given_up(study.runs, run, study.limit))
        if (const auto solution = time_solver(run, solve, limit, repeats)) run.errors = exact.errors(space, *solution);
      study.runs.push_back(std::move(run));
    }
    if (study.freefem.empty()) continue;
    TimedRun run = start("FreeFEM");
    if (!given_up(study.runs, run, study.limit))
      time_freefem(run, study.freefem, space, exact.table, study.limit, repeats, study.out / "freefem");
    study.runs.push_back(std::move(run));
  }
}

// **Stop when it is accurate enough**: Uzawa's two errors step by step, and where the bracket stops it.
Table stop_early(const Method& method, int cells, tutorial::Report& report) {
  const Exact exact(1e-2);
  const Scene scene = tutorial::paper_scene(exact.epsilon);
  const Discretisation on = method.on(cells);
  const VariationalInequality problem = assemble(scene, on.space());
  const auto error = [&](const Solution& solution) { return exact.errors(on.space(), solution).max; };
  Stopwatch watch;
  const Solution full = uzawa(problem);
  const double full_seconds = watch.lap();
  UzawaOptions options;
  options.enough = accurate_enough(energy_bracket(scene, method.mesh(cells / 2)), 2);
  const Solution early = uzawa(problem, options);
  fmt::print("{}: {:.4f} s, stopped early, with the bracket, {:.4f} s\n", method.name(), full_seconds, watch.lap());
  report.claim(error(early) < 1.01 * error(full) && 2 * early.counters.contact < full.counters.contact,
               "accurate enough: Uzawa stops after {} steps, not {}, at {:.4f} of the error", early.counters.contact,
               full.counters.contact, error(early) / error(full));
  Table table({"method", "quantity", "steps", "error"});
  table.add({method.name(), "accurate enough: stop", early.counters.contact, error(early)});
  for (double energy = 1e-3; energy > 1e-17; energy /= 4) {  // the iterates on the way
    options.enough = {energy, 1e-3};
    const Solution s = uzawa(problem, options);
    table.add({method.name(), "error of the iterate", s.counters.contact, error(s)});
    if (s.counters.contact < full.counters.contact)
      table.add({method.name(), "its algebraic part", s.counters.contact, (s.u - full.u).cwiseAbs().maxCoeff()});
  }
  return table;
}

void judge(const std::vector<TimedRun>& runs, tutorial::Report& report);

void work_precision(const tutorial::Options& options, tutorial::Report& report, Study study) {
  report.stage("truth for three epsilons");
  study.exact = tutorial::exact_solutions({1, 1e-2, 1e-6});
  for (int n = 8; n <= options.cells; n *= 2)
    for (const MeshFamily& family : {structured(), unstructured()}) {
      // ### Mesh
      report.stage(fmt::format("1/h = {}, {}", n, family.name));
      const Stopwatch watch;
      const TriangleMesh mesh = family.mesh(n);
      const double mesh_seconds = watch.seconds();
      for (const Element* element : {&p1(), &crouzeix_raviart()}) add(study, {element, family}, mesh, n, mesh_seconds);
    }
  report.stage("where the time goes");
  tutorial::write_stages(options.out, std::max(128, options.cells), repeats);
  report.finish();
  // ### Output
  write_runs(options.out / "work_precision.csv", study.runs);
  write_price_list(options.out, study.runs);
  tutorial::write_machine(options.out / "machine.csv");
  judge(study.runs, report);

  Table stopping({"method", "quantity", "steps", "error"});
  for (const Method& method : methods())
    if (method.name() != "CR structured")
      stopping.add(stop_early(method, std::min(options.cells, 64), report));  // finer, the last steps are minutes
  stopping.write(options.out / "stopping.csv");
}

void judge(const std::vector<TimedRun>& runs, tutorial::Report& report) {
  bool reliable = true, agree = true;
  double reference_error = 0, locked = 0, free = 0;  // the last two on the finest mesh
  for (const TimedRun& r : runs) {
    reliable = reliable && (r.ok || r.solver != "active set");
    if (r.solver == "active set") reference_error = r.errors.max;  // the first solver of each problem
    if (r.solver == "Uzawa, Cholesky" && r.ok)
      agree = agree && std::abs(reference_error - r.errors.max) <= 1e-3 * reference_error;
    if (r.mesh == "unstructured" && r.epsilon == 1e-6 && r.solver == "active set")
      (r.element == "P1" ? locked : free) = r.relative();
  }
  report.claim(reliable, "the active set answers on every mesh and at every epsilon");
  report.claim(agree, "where Uzawa ends within its limit, its error is that of the active set");
  report.claim(locked > 5 * free,
               "no time buys accuracy from P1 on the unstructured mesh at epsilon = 1e-6: {:.1e} relative, "
               "Crouzeix-Raviart {:.1e}",
               locked, free);
}

// ## What came out
//
// (a) The linear solves of the active set do not grow. It needs at most 4 contact steps, on fine meshes 1 or 2, since
// it starts from the contact set of a coarser one. Uzawa's steps grow with the condition number of the compliance of
// $Γ_C$: each time $h$ is halved, by the factor 2 at ε = 1 and by almost 4 at 1e-6 (chapter 04). With the paper's
// linear solver Uzawa gives up at small ε.
// (b) No: it comes to a level line. The bracket stops Uzawa there, after less than half of the steps, within
// 1 % of the error. The price list (`price_list.md`) says for each method what 1e-2, 1e-3 and 1e-4 cost, or "never".
//
// ## Exercises
//
// Predict, then run `--exercise 1`. On paper: an error of order $h^2$ and seconds that grow like $N = h^{-2}$; what
// does one digit more cost? And where the error is of order $h$?
int main(int argc, char** argv) {
  double limit = 0.1;
  std::string freefem;
  tutorial::Options options;
  options.exercises = {
      {"P1 structured at epsilon = 1e-2, 1/h = 8, 16, 32, 64: how do the contact steps of the active set grow, and "
       "those of Uzawa?",
       "the active set's do not, at most 4 and fewer on fine meshes; Uzawa's grow with every refinement",
       [](const tutorial::Options&, tutorial::Report& report) {
         Table counts({"cells", "active set", "Uzawa"});
         for (const int n : {8, 16, 32, 64}) {
           const Discretisation on(structured_mesh(n), p1());
           const VariationalInequality problem = assemble(tutorial::paper_scene(1e-2), on.space());
           counts.add({n, active_set(problem).counters.contact, uzawa(problem).counters.contact});
         }
         counts.print();
         report.claim(counts.most("active set") <= 4, "active set: {} steps at most", counts.most("active set"));
         report.claim(counts.order("Uzawa", "cells") > 0.5, "Uzawa: steps like (1/h)^{:.2f}",
                      counts.order("Uzawa", "cells"));
       }}};
  options.takes_epsilon = false;
  options.cells = 64;
  options.least_cells = 16;  // the study needs two meshes from 1/8 on
  options.add = [&](tutorial::CommandLine& line) {
    line.add("--limit", limit, "seconds after which a run counts as failed", 1e-3, 3600);
    line.add("--freefem", freefem, "the command freefem/run, to measure FreeFEM's script too");
  };
  return tutorial::run(argc, argv, "18_work_precision", "What accuracy costs in time", options,
                       [&](const tutorial::Options& o, tutorial::Report& r) {
                         work_precision(o, r, {limit, freefem, o.out});
                       });
}
