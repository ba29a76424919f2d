#pragma once
#include <cholmod.h>

#include <array>
#include <ctime>
#include <fstream>
#include <numeric>
#include <thread>

#include "antilock/core/detail/blas.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/io/writers.hpp"
#include "common/course.hpp"

namespace antilock::tutorial {

/// Where the time goes: stages.csv, wall seconds of each stage of the run of median length, 1/h from 16 to `finest` (P1,
/// structured mesh, active set, epsilon = 1e-6). `corrections` holds all of the solver that is no other stage.
inline void write_stages(const std::filesystem::path& folder, int finest, int repeats) {
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

/// What the seconds were measured on: processor, cores, threads of the BLAS, compiler, libraries, date: `what,value`.
inline void write_machine(const std::filesystem::path& path) {
  std::ifstream info("/proc/cpuinfo");
  std::string processor = "unknown", line;
  while (std::getline(info, line))
    if (line.starts_with("model name")) processor = line.substr(line.find(':') + 2);
  std::array<char, 32> date{};
  const std::time_t now = std::time(nullptr);
  std::strftime(date.data(), date.size(), "%F %R UTC", std::gmtime(&now));
  const Blas used = blas();
  Table table({"what", "value"});
  const auto version = [](auto a, auto b, auto c) { return fmt::format("{}.{}.{}", a, b, c); };
  table.add({"processor", processor});
  table.add({"cores", std::thread::hardware_concurrency()});
  table.add({"BLAS", fmt::format("{} with {} kernels on {} threads", used.name,
                                 used.kernel.empty() ? "unknown" : used.kernel, used.threads)});
  if (!used.wider.empty()) table.add({"wider kernels than these", fmt::format("OPENBLAS_CORETYPE={}", used.wider)});
#ifdef __clang__
  table.add({"compiler", __VERSION__});  // its own name is part of it
#else
  table.add({"compiler", std::string("GCC ") + __VERSION__});
#endif
  table.add({"Eigen", version(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)});
  table.add({"CHOLMOD", version(CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION)});
  table.add({"date", date.data()});
  table.write(path);
}

}  // namespace antilock::tutorial
