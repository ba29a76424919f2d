// What accuracy costs in time: the error against wall seconds, where the seconds go, and when to stop.
//
// Run: 10_work_precision                           h from 1/8 to 1/32; a few seconds
// Run: 10_work_precision --cells 256 --limit 4     h down to 1/256; minutes (figures/benchmark does this)
// Run: 10_work_precision --freefem freefem/run     FreeFEM's active set beside them, the stiff part summed as it comes
//
// --epsilon is not asked for here: the study has three of its own.
//
// A method is an element, a kind of mesh and a solver. Three solvers of (23): the primal-dual active set on Gamma_C,
// Uzawa with a Cholesky factor, and Uzawa as the paper ran it, with conjugate gradients and ILUT. Each point is the
// median of five runs, mesh and assembly apart. What fails, or takes longer than the limit, is drawn as failed; where
// time was the reason, finer meshes are not tried.
//
// What to see. A good method is a line that falls steeply, far to the left. At epsilon = 1e-6, P1 on the unstructured
// mesh is a level line: it has locked, and no time buys accuracy.
//
// When to stop. Uzawa's algebraic error |u_k - u_h| falls by a constant factor a step, for ever; the discretisation
// error |u_h - u| stays. Once the one is below the other the steps buy nothing, but neither is known: u and u_h are
// not. Two computable numbers stand for them. The duality gap, the energy of u_k pushed out of the obstacle less the
// dual energy of lambda_k, is above |u_k - u_h|_a^2 / 2. The energy bracket (16_energy_bracket) holds J(u), its width
// is of order h^2, and a mesh twice as coarse gives it at a quarter of the price. See analysis/accurate_enough.hpp.
//
// Load chosen here, f = 10 sin(2 pi x); the paper gives none.

#include <fmt/format.h>

#include <array>
#include <map>

#include "antilock/analysis/accurate_enough.hpp"
#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/exact/truth_table.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/exhibits/uzawa_cg_ilut.hpp"
#include "antilock/solve/uzawa.hpp"
#include "common/timed_runs.hpp"
#include "common/tutorial.hpp"

using namespace antilock;
using tutorial::TimedRun;

constexpr std::array epsilons{1.0, 1e-2, 1e-6};
constexpr int repeats = 5;

Scene layer_in_contact(double epsilon) { return Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{}); }

TriangleMesh make_mesh(const std::string& kind, int cells) {
  return kind == "structured" ? structured_mesh(cells) : unstructured_mesh(cells);
}

// 1. Work and precision: every method at every epsilon on one mesh.
class Study {
 public:
  Study(double limit, std::string freefem, std::filesystem::path out)
      : limit_(limit), freefem_(std::move(freefem)), out_(std::move(out)) {
    for (const double epsilon : epsilons) truth_.emplace(epsilon, TruthTable(Truth(paper_sine_load(), epsilon)));
  }

  void add(const std::string& kind, int cells) {
    const Stopwatch watch;
    const TriangleMesh mesh = make_mesh(kind, cells);
    const double mesh_seconds = watch.seconds();
    for (const std::string name : {"P1", "CR"}) {
      const Space space(mesh, element(name));
      for (const double epsilon : epsilons) {
        const VariationalInequality problem = assemble(layer_in_contact(epsilon), space);
        for (const std::string solver : {"active set", "Uzawa, Cholesky", "Uzawa, CG + ILUT", "FreeFEM"}) {
          if (solver == "FreeFEM" && freefem_.empty()) continue;
          TimedRun run{.element = name, .mesh = kind, .solver = solver, .epsilon = epsilon, .cells = cells};
          run.unknowns = problem.free_count();
          run.mesh_seconds = mesh_seconds;
          measure(run, space, problem);
          runs.push_back(std::move(run));
        }
      }
    }
  }

  std::vector<TimedRun> runs;

 private:
  void measure(TimedRun& run, const Space& space, const VariationalInequality& problem) {
    const TruthTable& truth = truth_.at(run.epsilon);
    if (given_up(runs, run, limit_)) return;
    if (run.solver == "FreeFEM") return time_freefem(run, freefem_, space, truth, limit_, repeats, out_ / "freefem");
    UzawaOptions options;
    options.max_seconds = limit_;
    const auto solve = [&] {
      if (run.solver == "active set") return active_set(problem);
      return run.solver == "Uzawa, Cholesky" ? uzawa(problem, options) : uzawa_cg_ilut(problem, options);
    };
    // the active set without a limit: no verdict may hang on the machine
    const double limit = run.solver == "active set" ? std::numeric_limits<double>::infinity() : limit_;
    const auto solution = time_solver(run, solve, limit, repeats);
    if (solution) run.errors = measure_errors(space, *solution, run.epsilon, reference(truth));
  }

  double limit_;
  std::string freefem_;
  std::filesystem::path out_;
  std::map<double, TruthTable> truth_;
};

// 2. Stop when it is accurate enough: Uzawa's two errors step by step, and where the bracket stops it.
void stop_early(const tutorial::Options& options, tutorial::Report& report) {
  constexpr double epsilon = 1e-2;
  const int cells = std::min(options.cells, 64);  // finer, the steps to the last digit are minutes
  const Scene scene = layer_in_contact(epsilon);
  const TruthTable truth(Truth(paper_sine_load(), epsilon));
  write_file(options.out / "stopping.csv", [&](std::ostream& out) {
    out << "method,quantity,steps,error\n";
    for (const auto& [name, kind] : {std::pair{"P1", "structured"}, {"P1", "unstructured"}, {"CR", "unstructured"}}) {
      const TriangleMesh mesh = make_mesh(kind, cells), coarse = make_mesh(kind, cells / 2);
      const Space space(mesh, element(name));
      const VariationalInequality problem = assemble(scene, space);
      UzawaOptions uzawa_options;
      Stopwatch watch;
      const Solution full = uzawa(problem);
      const double full_seconds = watch.lap();
      uzawa_options.enough = accurate_enough(energy_bracket(scene, coarse), 2);
      const Solution early = uzawa(problem, uzawa_options);
      const double early_seconds = watch.lap();
      const auto error = [&](const Solution& s) { return measure_errors(space, s, epsilon, reference(truth)).max; };
      fmt::print("{} {}: {:.4f} s, stopped early, with the bracket, {:.4f} s\n", name, kind, full_seconds,
                 early_seconds);
      report.claim(error(early) < 1.01 * error(full) && 2 * early.counters.contact < full.counters.contact,
                   fmt::format("accurate enough: Uzawa stops after {} steps, not {}, at {:.4f} of the error",
                               early.counters.contact, full.counters.contact, error(early) / error(full)));
      const auto row = [&](const char* quantity, const Solution& at, double value) {
        out << fmt::format("{} {},{},{},{}\n", name, kind, quantity, at.counters.contact, value);
      };
      row("accurate enough: stop", early, error(early));
      for (double energy = 1e-3; energy > 1e-17; energy /= 4) {  // the iterates on the way
        uzawa_options.enough = {energy, 1e-3};
        const Solution s = uzawa(problem, uzawa_options);
        row("error of the iterate", s, error(s));
        if (s.counters.contact < full.counters.contact)
          row("its algebraic part", s, (s.u - full.u).cwiseAbs().maxCoeff());
      }
    }
  });
}

// 3. The verdicts: nothing about seconds, which depend on the machine.
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
  report.claim(locked > 5 * free, fmt::format("no time buys accuracy from P1 on the unstructured mesh at epsilon = "
                                              "1e-6: {:.1e} relative, Crouzeix-Raviart {:.1e}",
                                              locked, free));
}

void study(const tutorial::Options& options, tutorial::Report& report, double limit, const std::string& freefem) {
  report.stage("truth for three epsilons");
  Study study(limit, freefem, options.out);
  for (int n = 8; n <= options.cells; n *= 2)
    for (const std::string kind : {"structured", "unstructured"}) {
      report.stage(fmt::format("1/h = {}, {}", n, kind));
      study.add(kind, n);
    }
  report.stage("where the time goes");
  tutorial::write_stages(options.out, std::max(128, options.cells), repeats);
  report.finish();
  write_runs(options.out / "work_precision.csv", study.runs);
  write_price_list(options.out, study.runs);
  tutorial::write_machine(options.out / "machine.csv");
  judge(study.runs, report);
  stop_early(options, report);
}

// Three things to try:
// - --limit 10: Uzawa as in the paper ends on more meshes, and price_list.md says what that costs.
// - OPENBLAS_NUM_THREADS=1 in front: small meshes are faster on one thread.
// - accurate_enough(..., 2, 1): too generous? And corrections_until(...) for the corrections of active_set.
int main(int argc, char** argv) {
  double limit = 0.1;
  std::string freefem;
  tutorial::Options options;
  options.takes_epsilon = false;
  options.least_cells = 16;  // the study needs two meshes from 1/8 on
  options.add = [&](tutorial::CommandLine& line) {
    line.add("--limit", limit, "seconds after which a run counts as failed", 1e-3, 3600);
    line.add("--freefem", freefem, "the command freefem/run, to measure FreeFEM's script too");
  };
  return tutorial::run(argc, argv, "10_work_precision", "What accuracy costs in time", options,
                       [&](const tutorial::Options& o, tutorial::Report& r) { study(o, r, limit, freefem); });
}
