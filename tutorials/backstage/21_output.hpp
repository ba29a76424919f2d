#pragma once
#include <cstdlib>
#include <fstream>

#include "antilock/io/writers.hpp"
#include "antilock/solve/uzawa.hpp"
#include "backstage/21_timing.hpp"
#include "common/tutorial.hpp"

namespace antilock::tutorial {

/// FreeFEM's active set on the same mesh, where its command is given, the stiff part summed as a plain script does. The
/// clock is the script's own, the last number of its summary, without start-up and reading the mesh.
inline void add_freefem(Timing& study, TimedRun run, const Space& space, const TruthTable& truth) {
  if (study.freefem.empty()) return;
  run.solver = "FreeFEM";
  if (study.given_up(run)) return study.runs.push_back(std::move(run));
  const auto folder = study.out / "freefem", mesh = folder / "mesh.freefem.msh", summary = folder / "summary.csv";
  std::filesystem::create_directories(folder);
  write_freefem_mesh(mesh, space.mesh());
  // what stands before the script's own clock, forms and all, may take a while, too
  const std::string line =
      fmt::format("timeout {} {} {} -mesh {} -out {} -epsilon {} -stiff sum > /dev/null 2>&1", study.limit + 5,
                  in_shell(study.freefem), run.element == "P1" ? "05_p1_structured" : "08_crouzeix_raviart",
                  in_shell(mesh.string()), in_shell(folder.string()), run.epsilon);
  std::vector<double> seconds;
  for (int i = 0; i < study.repeats && run.ok; ++i) {
    std::filesystem::remove(summary);
    const bool ended = std::system(line.c_str()) == 0;
    std::ifstream file(summary);
    std::string header, values;
    if (!ended || !std::getline(file, header) || !std::getline(file, values))
      run.fail(study.limit, "failed or took too long");
    else if (seconds.push_back(std::stod(values.substr(values.rfind(',') + 1))); seconds.back() > study.limit)
      run.fail(seconds.back(), fmt::format("took longer than {:g} s", study.limit));
  }
  if (run.ok) {
    run.note(std::move(seconds));
    std::ifstream solution(folder / "solution.csv");
    std::string header;
    std::getline(solution, header);
    double x = 0, y = 0, u = 0;
    for (char comma = 0; solution >> x >> comma >> y >> comma >> u; run.scale = std::max(run.scale, std::abs(u)))
      run.errors.max_at_unknowns = std::max(run.errors.max_at_unknowns, std::abs(u - truth.value(x, y)));
  }
  study.runs.push_back(std::move(run));
}

/// One row per run; status is ok or failed. `relative` and the errors are 0 where it failed.
inline void write_runs(const std::filesystem::path& path, const std::vector<TimedRun>& runs) {
  Table table({"element", "mesh", "solver", "epsilon", "cells", "unknowns", "status", "seconds", "least", "most",
               "mesh_seconds", "iterations", "relative", "max_at_unknowns", "max", "h1", "energy", "why"});
  for (const TimedRun& r : runs)
    table.add({r.element, r.mesh, r.solver, r.epsilon, r.cells, r.unknowns, r.ok ? "ok" : "failed", r.seconds, r.least,
               r.most, r.mesh_seconds, r.iterations, r.ok ? r.relative() : 0, r.errors.max_at_unknowns, r.errors.max,
               r.errors.h1, r.errors.energy, r.why});
  table.write(path);
}

/// Uzawa's two errors on its way, for one method: method, quantity, steps, error. `early` is where it was stopped,
/// `full` where it ends by itself; `error` measures the error of a solution.
inline Table uzawa_on_its_way(const std::string& method, const VariationalInequality& problem, const Solution& early,
                              const Solution& full, const std::function<double(const Solution&)>& error) {
  Table table({"method", "quantity", "steps", "error"});
  table.add({method, "accurate enough: stop", early.counters.contact, error(early)});
  PenaltyFactor factor(problem, {}, ContactRoad::dense);  // one for every stop
  Solution u;
  double error_of_u = 0;
  for (double energy = 1e-3; energy > 1e-17; energy /= 4) {
    UzawaOptions options;
    options.enough = {energy, 1e-3};
    const int before = u.counters.contact;
    if (before < full.counters.contact) u = uzawa(problem, factor, options);  // else it has come to its end
    if (u.counters.contact != before) error_of_u = error(u);                  // else it is the same u
    table.add({method, "error of the iterate", u.counters.contact, error_of_u});
    if (u.counters.contact < full.counters.contact)
      table.add({method, "its algebraic part", u.counters.contact, (u.u - full.u).cwiseAbs().maxCoeff()});
  }
  return table;
}

}  // namespace antilock::tutorial
