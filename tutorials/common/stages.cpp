#include <algorithm>
#include <array>
#include <numeric>

#include "antilock/core/stopwatch.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/table.hpp"
#include "common/paper_problem.hpp"
#include "common/timed_runs.hpp"

namespace antilock::tutorial {

void write_stages(const std::filesystem::path& folder, int finest, int repeats) {
  const Scene scene = paper_scene(1e-6);
  const auto scratch = folder / "stages_solution.csv";
  using Stages = std::array<double, 7>;
  const auto total = [](const Stages& s) { return std::accumulate(s.begin(), s.end(), 0.0); };
  const auto run = [&](int n) {
    Stopwatch watch;
    const TriangleMesh mesh = structured_mesh(n);
    const double mesh_seconds = watch.lap();
    const Space space(mesh, p1());
    const VariationalInequality problem = assemble(scene, space);
    const double assembly = watch.lap();
    const Solution solution = active_set(problem);
    const SolveSeconds& s = solution.seconds;
    const double rest = watch.lap() - s.total();  // the sum K before the factor, residuals and the KKT report after
    write_solution_csv(scratch, space, solution.u);
    return Stages{mesh_seconds, assembly, s.analyse, s.factor, s.contact, s.solve + rest, watch.lap()};
  };
  Table table({"cells", "mesh", "assembly", "analyse", "factor", "contact", "corrections", "output"});
  for (int n = 16; n <= finest; n *= 2) {
    std::vector<Stages> runs;
    runs.reserve(repeats);
    for (int i = 0; i < repeats; ++i) runs.push_back(run(n));
    std::sort(runs.begin(), runs.end(), [&](const Stages& a, const Stages& b) { return total(a) < total(b); });
    const auto [mesh, assembly, analyse, factor, contact, corrections, output] = runs[runs.size() / 2];
    table.add({n, mesh, assembly, analyse, factor, contact, corrections, output});
  }
  table.write(folder / "stages.csv");
  std::filesystem::remove(scratch);
}

}  // namespace antilock::tutorial
