#include <fmt/format.h>

#include "antilock/io/atomic_file.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/problem/assemble.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/stopwatch.hpp"
#include "common/timed_runs.hpp"

namespace antilock::tutorial {

void write_stages(const std::filesystem::path& folder, int finest) {
  const Scene scene(Body{paper_load}, StiffLayer{1e-6}, UnilateralContact{});
  write_file(folder / "stages.csv", [&](std::ostream& out) {
    out << "cells,mesh,assembly,analyse,factor,contact,corrections,output\n";
    for (int n = 16; n <= finest; n *= 2) {
      Stopwatch watch;
      const TriangleMesh mesh = structured_mesh(n);
      const double mesh_seconds = watch.lap();
      const Space space(mesh, p1());
      const VariationalInequality problem = assemble(scene, space);
      const double assembly = watch.lap();
      const Solution solution = active_set(problem);
      const SolveSeconds& s = solution.seconds;
      const double rest = watch.lap() - s.total();  // the sum K before the factor, residuals and the KKT report after
      write_solution_csv(folder / "stages_solution.csv", space, solution.u);
      out << fmt::format("{},{},{},{},{},{},{},{}\n", n, mesh_seconds, assembly, s.analyse, s.factor, s.contact,
                         s.solve + rest, watch.lap());
    }
  });
  std::filesystem::remove(folder / "stages_solution.csv");
}

}  // namespace antilock::tutorial
