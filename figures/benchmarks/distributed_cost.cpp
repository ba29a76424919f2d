// Measures the cost of the distributed solver and of the serial one on the structured mesh. Each
// run prints one line of numbers.
//
// Run:    mpiexec -n 2 distributed_cost --cells 1024        PETSc, on two ranks
//         distributed_cost --cells 1024 --serial            the library's own factor, in this process
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <ctime>

#include "antilock/core/standard_output.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/distributed/nested.hpp"
#include "antilock/distributed/ranks.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "programs/program.hpp"

using namespace antilock;

namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Of A1 u + B' M B u once: what other machines can compare.
double residual_seconds(const VariationalInequality& problem, const Eigen::VectorXd& u) {
  constexpr int times = 10;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(u.size());
  const double before = cpu_seconds();
  for (int i = 0; i < times; ++i) {
    sum.noalias() += problem.a1 * u;
    sum.noalias() += problem.b.transpose() * problem.m.cwiseProduct(problem.b * u);
  }
  return (cpu_seconds() - before) / times;
}

void serial(const Scene& scene, const Element& element, int cells) {
  Stopwatch watch;
  TriangleMesh mesh = structured_mesh(cells);
  const double mesh_seconds = watch.lap();
  const Space space(std::move(mesh), element);
  const VariationalInequality problem = assemble(scene, space);
  const double assemble_seconds = watch.lap();
  const double before = cpu_seconds();
  const Solution solution = active_set(problem);
  fmt::print("serial,{},1,{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},0,{},0,{},{:.0f},{:.1e},{:.3g}\n",
             element.name(), problem.free_count(), mesh_seconds, assemble_seconds,
             solution.seconds.analyse + solution.seconds.factor,
             solution.seconds.contact + solution.seconds.solve, cpu_seconds() - before,
             solution.counters.corrections, solution.counters.contact_iterations,
             distributed::peak_megabytes(), solution.kkt.residual,
             residual_seconds(problem, solution.u));
}

void petsc(const Scene& scene, const Element& element, int cells, bool levels) {
  int coarse = cells, refinements = 0;
  while (coarse % 2 == 0 && coarse / 2 >= std::max(16, 8 * distributed::ranks()))
    coarse /= 2, ++refinements;
  distributed::NestedOptions options;
  options.refinements = refinements;
  distributed::NestedReport report;
  const auto level =
      distributed::solve_nested(scene, structured_mesh(coarse), element, options, report);
  const double peak = distributed::peak_megabytes();
  const double residual = residual_seconds(level->problem.part(), level->state.u);
  double processor = 0;
  for (const distributed::LoopReport& loop : report.loops) processor += loop.processor;
  if (distributed::rank() > 0) return;
  fmt::print("petsc,{},{},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{},{},{},{},{:.0f},{:.1e},{:.3g}\n",
             element.name(), distributed::ranks(), report.unknowns.back(), report.mesh,
             report.assemble, report.setup, report.solve, processor, report.last.linear_iterations,
             report.last.corrections, report.last.max_iterations, report.last.set_changes, peak,
             report.kkt.residual, residual);
  for (std::size_t l = 0; levels && l < report.loops.size(); ++l)
    fmt::print(
        "  {} unknowns: {} corrections, {} iterations (most {}), {} setups; setup {:.3f} s, solve "
        "{:.3f} s\n",
        report.unknowns[l], report.loops[l].corrections, report.loops[l].linear_iterations,
        report.loops[l].max_iterations, report.loops[l].setups, report.loops[l].seconds_setup,
        report.loops[l].seconds_solve);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App line(
      "The cost of the distributed solver and of the serial one: "
      "solver,element,ranks,unknowns,mesh,assemble,setup or factor,solve,CPU of these "
      "two,iterations,corrections,"
      "most iterations,contact sets,peak MB of the largest rank,residual,seconds of one residual",
      "distributed_cost");
  int cells = 256;
  double epsilon = 1e-6;
  std::string name = "P1";
  bool alone = false, levels = false;
  line.add_option("--cells", cells, "1/h")->check(CLI::Range(1, 1 << 14));
  line.add_option("--epsilon", epsilon, "epsilon")->check(CLI::Range(0.0, 1.0));
  line.add_option("--element", name, "P1 or CR");
  line.add_flag("--serial", alone, "the serial library");
  line.add_flag("--levels", levels, "every level too");
  if (const auto status = tutorial::parse(line, argc, argv)) return *status;
  const distributed::Session session;
  try {
    const Scene scene({paper_load}, StiffLayer{epsilon}, UnilateralContact{});
    if (alone)
      serial(scene, element(name), cells);
    else
      petsc(scene, element(name), cells, levels);
  } catch (const Error& error) {
    if (distributed::rank() == 0) fmt::print(stderr, "distributed_cost: {}\n", error.what());
    return 3;
  }
  return delivered(0, "distributed_cost");
}
