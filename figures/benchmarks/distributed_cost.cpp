// Measures the cost of the distributed solver and of the serial one on the structured mesh, or on a
// layer without columns. Each run prints one line of numbers.
//
// Run:    mpiexec -n 2 distributed_cost --cells 1024        PETSc, on two ranks
//         distributed_cost --cells 1024 --serial            the library's own factor, in this process
//         mpiexec -n 2 distributed_cost --cells 256 --element CR --mesh unstructured
//         mpiexec -n 2 distributed_cost --cells 256 --element CR --mesh unstructured --direct
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <string>
#include <utility>

#include "antilock/core/standard_output.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/distributed/nested.hpp"
#include "antilock/distributed/ranks.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/mesh/refine.hpp"
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

/// A coarse mesh and the number of its refinements.
struct Hierarchy {
  TriangleMesh coarse;
  int refinements = 0;
};

TriangleMesh coarse_mesh(const std::string& kind, int cells) {
  if (kind == "structured") return structured_mesh(cells);
  if (kind == "delaunay") return unstructured_mesh(cells, {}, Mesher::delaunay);
  if (kind == "jittered") return jittered_mesh(cells, 0.2);
  return unstructured_mesh(cells);
}

/// The structured mesh of 1/h = cells from as few cells as the ranks allow, or, without columns,
/// a mesh of at most 32 cells and more than 16, refined. The latter does not depend on the ranks,
/// so that all runs have the same mesh.
Hierarchy hierarchy(int cells, const std::string& kind) {
  const bool has_columns = kind == "structured";
  const int least = has_columns ? std::max(16, 8 * distributed::ranks()) : 17;
  Hierarchy h;
  int coarse = cells;
  while (coarse % 2 == 0 && coarse / 2 >= least) {
    coarse /= 2;
    ++h.refinements;
  }
  h.coarse = coarse_mesh(kind, coarse);
  return h;
}

void serial(const Scene& scene, const Element& element, int cells, const std::string& kind) {
  const bool has_columns = kind == "structured";
  Stopwatch watch;
  TriangleMesh mesh;
  if (has_columns) {
    mesh = structured_mesh(cells);
  } else {
    Hierarchy h = hierarchy(cells, kind);
    mesh = std::move(h.coarse);
    for (int l = 0; l < h.refinements; ++l) mesh = refined(mesh);
  }
  const double mesh_seconds = watch.lap();
  const Space space(std::move(mesh), element);
  const VariationalInequality problem = assemble(scene, space);
  const double assemble_seconds = watch.lap();
  const double before = cpu_seconds();
  const Solution solution = active_set(problem);
  fmt::print("{},{},1,{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},0,{},0,{},{:.0f},{:.1e},{:.3g}\n",
             has_columns ? "serial" : "serial-any", element.name(), problem.free_count(),
             mesh_seconds, assemble_seconds, solution.seconds.analyse + solution.seconds.factor,
             solution.seconds.contact + solution.seconds.solve, cpu_seconds() - before,
             solution.counters.corrections, solution.counters.contact_iterations,
             distributed::peak_megabytes(), solution.kkt.residual,
             residual_seconds(problem, solution.u));
}

void petsc(const Scene& scene, const Element& element, int cells, const std::string& kind,
           bool direct, bool levels) {
  const bool has_columns = kind == "structured";
  const Hierarchy h = hierarchy(cells, kind);
  distributed::NestedOptions options;
  options.refinements = h.refinements;
  if (direct) options.loop.preconditioner = distributed::Preconditioner::factor;
  distributed::NestedReport report;
  const auto level = distributed::solve_nested(scene, h.coarse, element, options, report);
  const double peak = distributed::peak_megabytes();
  const double residual = residual_seconds(level->problem.part(), level->state.u);
  double processor = 0;
  for (const distributed::LoopReport& loop : report.loops) processor += loop.processor;
  processor = distributed::largest(processor);
  if (distributed::rank() > 0) return;
  std::string solver = has_columns ? "petsc" : "petsc-any";
  if (direct) solver += "-mumps";
  fmt::print("{},{},{},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{},{},{},{},{:.0f},{:.1e},{:.3g}\n",
             solver, element.name(), distributed::ranks(), report.unknowns.back(), report.mesh,
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
      "two on the rank that has most,iterations,corrections,"
      "most iterations,contact sets,peak MB of the largest rank,residual,seconds of one residual",
      "distributed_cost");
  int cells = 256;
  double epsilon = 1e-6;
  std::string name = "P1";
  std::string mesh = "structured";
  bool alone = false;
  bool direct = false;
  bool levels = false;
  line.add_option("--cells", cells, "1/h")->check(CLI::Range(1, 1 << 14));
  line.add_option("--epsilon", epsilon, "epsilon")->check(CLI::Range(0.0, 1.0));
  line.add_option("--element", name, "P1 or CR");
  line.add_option("--mesh", mesh, "structured, or one whose layer has no columns")
      ->check(CLI::IsMember({"structured", "unstructured", "delaunay", "jittered"}));
  line.add_flag("--serial", alone, "the serial library");
  line.add_flag("--direct", direct, "MUMPS in place of the preconditioner");
  line.add_flag("--levels", levels, "every level too");
  if (const auto status = tutorial::parse(line, argc, argv)) return *status;
  const distributed::Session session;
  try {
    const Scene scene({paper_load}, StiffLayer{epsilon}, UnilateralContact{});
    if (alone)
      serial(scene, element(name), cells, mesh);
    else
      petsc(scene, element(name), cells, mesh, direct, levels);
  } catch (const Error& error) {
    if (distributed::rank() == 0) fmt::print(stderr, "distributed_cost: {}\n", error.what());
    return 3;
  }
  return delivered(0, "distributed_cost");
}
