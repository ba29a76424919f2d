// Measures one contact solve in three dimensions, for figures/benchmarks/three_dimensions. Each run
// is a process of its own, so that its peak memory is that of the solve. The load and the meshes
// are those of tutorials/39_three_dimensions, epsilon = 1e-6.
//
// Run: space_cost --cells 20 --element CR
//      space_cost --cells 20 --mesh unstructured --reduction sparse
//      space_cost --cells 20 --write cubes.mesh      the mesh in Medit's format, and no solve
#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <ctime>
#include <numbers>
#include <string>

#include "antilock/core/standard_output.hpp"
#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "programs/program.hpp"

using namespace antilock;

namespace {

/// Processor seconds, of all threads. Wall seconds depend on what else the machine does.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in kilobytes
}

double load(double x, double y, double z) {
  using std::numbers::pi;
  return 40 * std::pow(1 - z, 3) * std::sin(2 * pi * x) * std::sin(pi * y);
}

Mesh mesh_of(const std::string& kind, int cells) {
  const Domain cube_on_layer{1, CellKind::tetrahedron};
  return kind == "structured" ? structured_mesh(cells, cube_on_layer)
                              : unstructured_mesh(cells, cube_on_layer);
}

void measure(const Element& element, const std::string& kind, int cells,
             ContactReduction reduction) {
  const double start = processor_seconds();
  const Space space(mesh_of(kind, cells), element);
  const double meshed = processor_seconds();
  const Scene scene(Body{load}, StiffLayer{1e-6}, UnilateralContact{});
  const VariationalInequality problem = assemble(scene, space);
  const double assembled = processor_seconds();
  PenalisedCholesky factor(problem, {}, reduction);
  const double factored = processor_seconds();
  const Solution solution = active_set(problem, factor);
  const double end = processor_seconds();
  fmt::print("{},{},{},{},{},{:.0f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.0f},{},{:.6f}\n",
             element.name(), kind, cells, space.mesh().triangle_count(), problem.free_count(),
             factor.entries(), meshed - start, assembled - meshed, factored - assembled,
             end - factored, end, peak_megabytes(), solution.counters.corrections,
             solution.u(space.contact_dofs()).maxCoeff());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App line(
      "One contact solve in three dimensions: element,mesh,cells,tetrahedra,unknowns,entries of "
      "the factor,processor seconds of mesh,assembly,factor,contact and of the process,peak "
      "MB,corrections,largest u on Gamma_C",
      "space_cost");
  int cells = 8;
  std::string name = "P1", kind = "structured", reduction = "automatic", medit;
  line.add_option("--cells", cells, "1/h")->check(CLI::Range(1, most_structured_in_space));
  line.add_option("--element", name, "P1 or CR")->check(CLI::IsMember({"P1", "CR"}));
  line.add_option("--mesh", kind, "structured or unstructured")
      ->check(CLI::IsMember({"structured", "unstructured"}));
  line.add_option("--reduction", reduction, "of the contact: automatic or sparse")
      ->check(CLI::IsMember({"automatic", "sparse"}));
  line.add_option("--write", medit, "write the mesh, a file .mesh, and solve nothing");
  if (const auto status = tutorial::parse(line, argc, argv)) return *status;
  try {
    if (!medit.empty())
      write_freefem_mesh(medit, mesh_of(kind, cells));
    else
      measure(element(name, CellKind::tetrahedron), kind, cells,
              reduction == "sparse" ? ContactReduction::sparse : ContactReduction::automatic);
  } catch (const Error& error) {
    fmt::print(stderr, "space_cost: {}\n", error.what());
    return 2;
  }
  return delivered(0, "space_cost");
}
