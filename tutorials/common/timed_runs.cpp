#include "common/timed_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/io/writers.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {
namespace {

void note_seconds(TimedRun& run, std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  run.least = seconds.front();
  run.most = seconds.back();
  run.seconds = seconds[seconds.size() / 2];
}

void note_failure(TimedRun& run, double spent, std::string why) {
  run.ok = false;
  run.seconds = run.least = run.most = spent;
  std::replace(why.begin(), why.end(), ',', ';');  // one field of the table
  run.why = std::move(why);
}

/// The script's own seconds, the last number of its summary; nothing where it fails or takes too
/// long.
std::optional<double> script_seconds(const std::string& line, const std::filesystem::path& summary_file) {
  std::filesystem::remove(summary_file);
  if (std::system(line.c_str()) != 0) return {};
  std::ifstream summary(summary_file);
  std::string header, values;
  if (!std::getline(summary, header) || !std::getline(summary, values)) return {};
  return std::stod(values.substr(values.rfind(',') + 1));
}

}  // namespace

bool TimedRun::same_method(const TimedRun& other) const {
  return element == other.element && mesh == other.mesh && solver == other.solver && epsilon == other.epsilon;
}

bool given_up(const std::vector<TimedRun>& before, TimedRun& run, double limit) {
  const bool hopeless = std::any_of(before.begin(), before.end(), [&](const TimedRun& r) {
    return r.same_method(run) && !r.ok && r.seconds >= limit;
  });
  if (hopeless) note_failure(run, limit, "not tried: over the limit on a coarser mesh");
  return hopeless;
}

std::optional<Solution> time_solver(TimedRun& run, const std::function<Solution()>& solve, double limit, int repeats) {
  const Stopwatch since_start;
  std::vector<double> seconds;
  std::optional<Solution> solution;
  try {
    for (int i = 0; i < repeats; ++i) {
      const Stopwatch watch;
      solution = solve();
      seconds.push_back(watch.seconds());
      if (seconds.back() > limit) throw NotConverged(fmt::format("took longer than {:g} s", limit), 1, 0);
    }
  } catch (const Error& failure) {
    note_failure(run, since_start.seconds(), failure.what());
    return {};
  }
  note_seconds(run, std::move(seconds));
  run.iterations = solution->counters.contact;
  run.scale = solution->u.cwiseAbs().maxCoeff();
  return solution;
}

void time_freefem(TimedRun& run, const std::string& command, const Space& space, const TruthTable& truth, double limit,
                  int repeats, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const auto mesh = folder / "mesh.freefem.msh";
  write_freefem_mesh(mesh, space.mesh());
  // what stands before the script's own clock, forms and all, may take a while, too
  const std::string line = fmt::format(
      "timeout {} '{}' {} -mesh '{}' -out '{}' -epsilon {} -stiff sum > /dev/null 2>&1", limit + 5, command,
      run.element == "P1" ? "05_p1_structured" : "08_crouzeix_raviart", mesh.string(), folder.string(), run.epsilon);
  std::vector<double> seconds;
  for (int i = 0; i < repeats; ++i) {
    const auto taken = script_seconds(line, folder / "summary.csv");
    if (!taken) return note_failure(run, limit, "failed or took too long");
    if (*taken > limit) return note_failure(run, *taken, fmt::format("took longer than {:g} s", limit));
    seconds.push_back(*taken);
  }
  note_seconds(run, std::move(seconds));
  std::ifstream solution(folder / "solution.csv");
  std::string header;
  std::getline(solution, header);
  double x = 0, y = 0, u = 0;
  for (char comma = 0; solution >> x >> comma >> y >> comma >> u;) {
    run.errors.max_at_unknowns = std::max(run.errors.max_at_unknowns, std::abs(u - truth.value(x, y)));
    run.scale = std::max(run.scale, std::abs(u));
  }
}

void Timing::add(TimedRun run, const std::string& solver, const std::function<Solution()>& solve,
                 const std::function<Errors(const Solution&)>& errors, bool limited) {
  run.solver = solver;
  if (!given_up(runs, run, limit))
    if (const auto u = time_solver(run, solve, limited ? limit : std::numeric_limits<double>::infinity(), repeats))
      run.errors = errors(*u);
  runs.push_back(std::move(run));
}

void Timing::add_freefem(TimedRun run, const Space& space, const TruthTable& truth) {
  if (freefem.empty()) return;
  run.solver = "FreeFEM";
  if (!given_up(runs, run, limit)) time_freefem(run, freefem, space, truth, limit, repeats, out / "freefem");
  runs.push_back(std::move(run));
}

const TimedRun& Timing::finest(const Method& method, double epsilon) const {
  const auto wanted = [&](const TimedRun& r) {
    return r.solver == "active set" && r.element == method.element->name() && r.mesh == method.family.name &&
           r.epsilon == epsilon;
  };
  const auto found = std::find_if(runs.rbegin(), runs.rend(), wanted);
  if (found == runs.rend()) throw Error("no run of " + method.name());
  return *found;
}

void Timing::judge(Report& report) const {
  bool reliable = true, agree = true;
  double reference_error = 0;
  for (const TimedRun& r : runs) {
    reliable = reliable && (r.ok || r.solver != "active set");
    if (r.solver == "active set") reference_error = r.errors.max;  // the first solver of each problem
    if (r.solver == "Uzawa, Cholesky" && r.ok)
      agree = agree && std::abs(reference_error - r.errors.max) <= 1e-3 * reference_error;
  }
  report.claim(reliable, "the active set answers on every mesh and at every epsilon");
  report.claim(agree, "where Uzawa ends within its limit, its error is that of the active set");
}

void Timing::write(int finest) const {
  write_stages(out, std::max(128, finest), repeats);
  write_runs(out / "work_precision.csv", runs);
  write_price_list(out, runs);
  write_machine(out / "machine.csv");
}

void write_runs(const std::filesystem::path& path, const std::vector<TimedRun>& runs) {
  Table table({"element", "mesh", "solver", "epsilon", "cells", "unknowns", "status", "seconds", "least", "most",
               "mesh_seconds", "iterations", "relative", "max_at_unknowns", "max", "h1", "energy", "why"});
  for (const TimedRun& r : runs)
    table.add({r.element, r.mesh, r.solver, r.epsilon, r.cells, r.unknowns, r.ok ? "ok" : "failed", r.seconds, r.least,
               r.most, r.mesh_seconds, r.iterations, r.ok ? r.relative() : 0, r.errors.max_at_unknowns, r.errors.max,
               r.errors.h1, r.errors.energy, r.why});
  table.write(path);
}

}  // namespace antilock::tutorial
