#pragma once
#include <cholmod.h>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <numeric>
#include <thread>
#include <tuple>

#include "antilock/core/blas.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/io/write_csv.hpp"
#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/solve/uzawa.hpp"
#include "course/chapter.hpp"
#include "course/course.hpp"
#include "course/markdown.hpp"
#include "programs/program.hpp"

namespace antilock::tutorial {

/// Where the time goes: stages.csv, wall seconds of each stage of the run of median length,
/// 1/h from 16 to `finest` (P1, structured mesh, active set, epsilon = 1e-6). `corrections`
/// holds all of the solver that is no other stage.
inline void write_stages(const std::filesystem::path& folder, int finest, int repeats) {
  const Scene scene = paper_scene(1e-6);
  const auto scratch = folder / "stages_solution.csv";
  using Stages = std::array<double, 7>;
  const auto total = [](const Stages& s) {
    return std::accumulate(s.begin(), s.end(), 0.0);
  };
  const auto run = [&](int n) {
    Stopwatch watch;
    TriangleMesh mesh = structured_mesh(n);
    const double mesh_seconds = watch.lap();
    const Space space(std::move(mesh), p1());
    const VariationalInequality problem = assemble(scene, space);
    const double assembly = watch.lap();
    const Solution solution = active_set(problem);
    const SolveSeconds& s = solution.seconds;
    const double rest =
        watch.lap() -
        s.total();  // the sum K before the factor, residuals and the KKT report after
    write_solution_csv(scratch, space, solution.u);
    return Stages{mesh_seconds, assembly,       s.analyse,  s.factor,
                  s.contact,    s.solve + rest, watch.lap()};
  };
  Table table({"cells", "mesh", "assembly", "analyse", "factor", "contact", "corrections",
               "output"});
  for (int n = 16; n <= finest; n *= 2) {
    std::vector<Stages> runs;
    runs.reserve(repeats);
    for (int i = 0; i < repeats; ++i) runs.push_back(run(n));
    std::sort(runs.begin(), runs.end(),
              [&](const Stages& a, const Stages& b) { return total(a) < total(b); });
    const auto [mesh, assembly, analyse, factor, contact, corrections, output] =
        runs[runs.size() / 2];
    table.add({n, mesh, assembly, analyse, factor, contact, corrections, output});
  }
  table.write(folder / "stages.csv");
  std::filesystem::remove(scratch);
}

/// What the seconds were measured on: processor, cores, threads of the BLAS, compiler,
/// libraries, date: `what,value`.
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
  const auto version = [](auto a, auto b, auto c) {
    return fmt::format("{}.{}.{}", a, b, c);
  };
  table.add({"processor", processor});
  table.add({"cores", std::thread::hardware_concurrency()});
  table.add(
      {"BLAS", fmt::format("{} with {} kernels on {} threads", used.name,
                           used.kernel.empty() ? "unknown" : used.kernel, used.threads)});
  if (!used.wider.empty())
    table.add(
        {"wider kernels than these", fmt::format("OPENBLAS_CORETYPE={}", used.wider)});
#ifdef __clang__
  table.add({"compiler", __VERSION__});  // its own name is part of it
#else
  table.add({"compiler", std::string("GCC ") + __VERSION__});
#endif
  table.add(
      {"Eigen", version(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)});
  table.add({"CHOLMOD",
             version(CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION)});
  table.add({"date", date.data()});
  table.write(path);
}

/// One point of the study: a method (element, kind of mesh, solver) at one epsilon on one
/// mesh. The wall seconds are the median and the extremes of the repeats; where it failed,
/// what was spent.
struct TimedRun {
  std::string element{}, mesh{}, solver{};
  double epsilon = 0;
  int cells = 0, unknowns = 0, iterations = 0;
  bool ok = true;
  double seconds = 0, least = 0, most = 0, mesh_seconds = 0;
  Errors errors{};    ///< of FreeFEM's script: max_at_unknowns alone
  double scale = 0;   ///< largest |u_h|
  std::string why{};  ///< of a failure
  double relative() const { return errors.max_at_unknowns / scale; }
  bool same_method(const TimedRun& other) const {  // on whatever mesh size
    return element == other.element && mesh == other.mesh && solver == other.solver &&
           epsilon == other.epsilon;
  }
  void note(std::vector<double> all) {
    std::sort(all.begin(), all.end());
    least = all.front(), most = all.back(), seconds = all[all.size() / 2];
  }
  void fail(double spent, std::string reason) {
    ok = false;
    seconds = least = most = spent;
    std::replace(reason.begin(), reason.end(), ',', ';');  // one field of the table
    why = std::move(reason);
  }
};

/// What a run may take, and the runs so far.
struct Timing {
  double limit =
      0.1;  ///< seconds after which a run counts as failed, even where its answer is good
  std::string freefem;  ///< the command freefem/run, or nothing: then FreeFEM is not timed
  std::filesystem::path out;  ///< folder of the results
  int repeats = 5;
  std::vector<TimedRun> runs{};

  bool given_up(TimedRun& run)
      const {  // failed, where the same method was over the limit on a coarser mesh
    const auto over = [&](const TimedRun& r) {
      return r.same_method(run) && !r.ok && r.seconds >= limit;
    };
    const bool hopeless = std::any_of(runs.begin(), runs.end(), over);
    if (hopeless) run.fail(limit, "not tried: over the limit on a coarser mesh");
    return hopeless;
  }
  /// Times one solver. `run` says what is solved: element, mesh, epsilon, cells, unknowns,
  /// mesh_seconds.
  void add(TimedRun run, const std::string& solver, const std::function<Solution()>& solve,
           const std::function<Errors(const Solution&)>& errors,
           bool limited = true) {  // false: no limit stops it
    run.solver = solver;
    if (!given_up(run)) {
      const Stopwatch since_start;
      std::vector<double> seconds;
      Solution solution;
      try {
        for (int i = 0; i < repeats; ++i) {
          const Stopwatch watch;
          solution = solve();
          seconds.push_back(watch.seconds());
          if (limited && seconds.back() > limit)
            throw NotConverged(fmt::format("took longer than {:g} s", limit), 1, 0);
        }
        run.note(std::move(seconds));
      } catch (const Error& failure) {
        run.fail(since_start.seconds(), failure.what());
      }
      if (run.ok) {
        run.iterations = solution.counters.contact_iterations;
        run.scale = solution.u.cwiseAbs().maxCoeff();
        run.errors = errors(solution);
      }
    }
    runs.push_back(std::move(run));
  }
};

/// FreeFEM's active set on the same mesh, where its command is given, the stiff part summed
/// as a plain script does. The clock is the script's own, the last number of its summary,
/// without start-up and reading the mesh.
inline void add_freefem(Timing& study, TimedRun run, const Space& space,
                        const ExactTable& exact) {
  if (study.freefem.empty()) return;
  run.solver = "FreeFEM";
  if (study.given_up(run)) return study.runs.push_back(std::move(run));
  const auto folder = study.out / "freefem", mesh = folder / "mesh.freefem.msh",
             summary = folder / "summary.csv";
  std::filesystem::create_directories(folder);
  write_freefem_mesh(mesh, space.mesh());
  // what stands before the script's own clock, forms and all, may take a while, too
  const std::string line = fmt::format(
      "timeout {} {} {} -mesh {} -out {} -epsilon {} -stiff sum > /dev/null 2>&1",
      study.limit + 5, in_shell(study.freefem),
      run.element == "P1" ? "05_p1_structured" : "08_crouzeix_raviart",
      in_shell(mesh.string()), in_shell(folder.string()), run.epsilon);
  std::vector<double> seconds;
  for (int i = 0; i < study.repeats && run.ok; ++i) {
    std::filesystem::remove(summary);
    const bool ended = std::system(line.c_str()) == 0;
    std::ifstream file(summary);
    std::string header, values;
    if (!ended || !std::getline(file, header) || !std::getline(file, values))
      run.fail(study.limit, "failed or took too long");
    else if (seconds.push_back(std::stod(values.substr(values.rfind(',') + 1)));
             seconds.back() > study.limit)
      run.fail(seconds.back(), fmt::format("took longer than {:g} s", study.limit));
  }
  if (run.ok) {
    run.note(std::move(seconds));
    std::ifstream solution(folder / "solution.csv");
    std::string header;
    std::getline(solution, header);
    double x = 0, y = 0, u = 0;
    for (char comma = 0; solution >> x >> comma >> y >> comma >> u;
         run.scale = std::max(run.scale, std::abs(u)))
      run.errors.max_at_unknowns =
          std::max(run.errors.max_at_unknowns, std::abs(u - exact.value(x, y)));
  }
  study.runs.push_back(std::move(run));
}

/// One row per run; status is ok or failed. `relative` and the errors are 0 where it
/// failed.
inline void write_runs(const std::filesystem::path& path,
                       const std::vector<TimedRun>& runs) {
  Table table({"element", "mesh", "solver", "epsilon", "cells", "unknowns", "status",
               "seconds", "least", "most", "mesh_seconds", "iterations", "relative",
               "max_at_unknowns", "max", "h1", "energy", "why"});
  for (const TimedRun& r : runs)
    table.add({r.element, r.mesh, r.solver, r.epsilon, r.cells, r.unknowns,
               r.ok ? "ok" : "failed", r.seconds, r.least, r.most, r.mesh_seconds,
               r.iterations, r.ok ? r.relative() : 0, r.errors.max_at_unknowns,
               r.errors.max, r.errors.h1, r.errors.energy, r.why});
  table.write(path);
}

/// Uzawa's two errors on its way, for one method: method, quantity, steps, error. `early`
/// is where it was stopped, `full` where it ends by itself; `error` measures the error of a
/// solution.
inline Table uzawa_on_its_way(const std::string& method,
                              const VariationalInequality& problem, const Solution& early,
                              const Solution& full,
                              const std::function<double(const Solution&)>& error) {
  Table table({"method", "quantity", "steps", "error"});
  table.add(
      {method, "accurate enough: stop", early.counters.contact_iterations, error(early)});
  PenalisedCholesky factor(problem, {},
                           ContactReduction::schur_complement);  // one for every stop
  Solution u;
  double error_of_u = 0;
  for (double energy = 1e-3; energy > 1e-17; energy /= 4) {
    UzawaOptions options;
    options.stop_at = {energy, 1e-3};
    const int before = u.counters.contact_iterations;
    if (before < full.counters.contact_iterations)
      u = uzawa(problem, factor, options);  // else it has come to its end
    if (u.counters.contact_iterations != before)
      error_of_u = error(u);  // else it is the same u
    table.add({method, "error of the iterate", u.counters.contact_iterations, error_of_u});
    if (u.counters.contact_iterations < full.counters.contact_iterations)
      table.add({method, "its algebraic part", u.counters.contact_iterations,
                 (u.u - full.u).cwiseAbs().maxCoeff()});
  }
  return table;
}

struct Price {
  std::string outcome;  ///< reached, never (locked: the error hardly falls), failed (before
                        ///< it came so far) or beyond
  double seconds = 0;   ///< beyond: of the finest mesh
  int unknowns = 0;
};

/// The cheapest of the runs, those of one method at one epsilon from coarse to fine, within
/// a relative error.
inline Price price(const std::vector<TimedRun>& runs, double tolerance) {
  std::vector<TimedRun> good;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(good),
               [](const TimedRun& r) { return r.ok; });
  Price best;
  for (const TimedRun& r : good)
    if (r.relative() <= tolerance && (best.outcome.empty() || r.seconds < best.seconds))
      best = {"reached", r.seconds, r.unknowns};
  if (!best.outcome.empty()) return best;
  // between two meshes of a method that converges the error falls by a factor of 2 at least
  if (good.size() > 1 && good.back().relative() > 0.9 * good[good.size() - 2].relative())
    return {"never"};
  if (good.size() < runs.size()) return {"failed"};
  return {"beyond", good.back().seconds, good.back().unknowns};
}

/// `unknowns: seconds of the first solver / the second / ...`, on one kind of mesh.
inline std::string cell(const std::vector<Price>& prices) {
  const Price& first = prices.front();
  if (first.outcome == "never" || first.outcome == "failed") return first.outcome;
  if (first.outcome == "beyond")
    return fmt::format("> {}: > {:.2g}", first.unknowns, first.seconds);
  std::string text = fmt::format("{}:", first.unknowns);
  for (const Price& p : prices)
    text += fmt::format("{} {}", &p == &first ? "" : " /",
                        p.outcome == "reached" ? fmt::format("{:.2g}", p.seconds) : "-");
  return text;
}

/// price_list.csv, one row per method, epsilon, solver and relative error, and
/// price_list.md, one per method and epsilon.
inline void write_price_list(const std::filesystem::path& folder,
                             const std::vector<TimedRun>& runs) {
  std::vector<std::vector<TimedRun>>
      methods;  // of each the runs from coarse to fine; solvers in their order
  for (const TimedRun& run : runs) {
    const auto known = std::find_if(methods.begin(), methods.end(),
                                    [&](const auto& m) { return m[0].same_method(run); });
    (known == methods.end() ? methods.emplace_back() : *known).push_back(run);
  }
  std::stable_sort(methods.begin(), methods.end(), [](const auto& a, const auto& b) {
    return std::tie(b[0].element, a[0].mesh, b[0].epsilon) <
           std::tie(a[0].element, b[0].mesh, a[0].epsilon);
  });
  constexpr std::array tolerances{1e-2, 1e-3, 1e-4};
  Table csv({"element", "mesh", "epsilon", "solver", "tolerance", "outcome", "seconds",
             "unknowns"});
  Table page({"element and mesh", "epsilon", "1e-2", "1e-3", "1e-4"});
  std::string solvers;
  for (auto first = methods.begin(), next = first; first != methods.end(); first = next) {
    const TimedRun& m = first->front();
    std::array<std::vector<Price>, tolerances.size()> row;
    const auto together = [&](const TimedRun& r) {
      return std::tie(r.element, r.mesh, r.epsilon);
    };
    for (solvers.clear(); next != methods.end() && together(next->front()) == together(m);
         ++next) {
      solvers += (solvers.empty() ? "" : " / ") + next->front().solver;
      for (std::size_t i = 0; i < tolerances.size(); ++i) {
        const Price& p = row[i].emplace_back(price(*next, tolerances[i]));
        csv.add({m.element, m.mesh, m.epsilon, next->front().solver, tolerances[i],
                 p.outcome, p.seconds, p.unknowns});
      }
    }
    page.add(
        {m.element + " " + m.mesh, m.epsilon, cell(row[0]), cell(row[1]), cell(row[2])});
  }
  csv.write(folder / "price_list.csv");
  write_markdown(
      folder / "price_list.md",
      fmt::format("The meshes have 1/h = 8 to {}. An entry has the number of "
                  "unknowns, a colon, and the seconds of {}. Mesh and assembly "
                  "are not counted. The relative error at the unknowns is then "
                  "below 1e-2, 1e-3 or 1e-4. `-` means that the solver failed or "
                  "took too long, `never` that the element locks, and `>` that "
                  "the finest mesh is too coarse.",
                  runs.back().cells, solvers),
      page);
}

/// Returns `unknowns: seconds` of the coarsest mesh whose relative energy error is within
/// the tolerance, or `>` and those of the finest mesh. `runs` are those of one element at
/// one epsilon, from coarse to fine.
inline std::string cheapest(const Table& runs, double tolerance) {
  const Table enough =
      runs.filter_number("relative", [&](double error) { return error <= tolerance; });
  if (enough.size() == 0)
    return fmt::format("> {}: > {:.2g}", runs.last("unknowns"), runs.last("seconds"));
  return fmt::format("{}: {:.2g}", enough.first("unknowns"), enough.first("seconds"));
}

/// Writes order_two.csv, the runs, and order_two.md, one row per element and epsilon.
inline void write_order_two(const std::filesystem::path& folder, const Table& runs,
                            int repeats) {
  Table page({"element", "epsilon", "10 %", "3 %", "1 %", "0.3 %"});
  for (const TableEntry& element : runs.unique("element"))
    for (const TableEntry& epsilon : runs.unique("epsilon")) {
      const Table here = runs.filter("element", element).filter("epsilon", epsilon);
      std::vector<TableEntry> row{element, epsilon};
      for (const double tolerance : {0.1, 0.03, 0.01, 0.003})
        row.emplace_back(cheapest(here, tolerance));
      page.add(std::move(row));
    }
  runs.write(folder / "order_two.csv");
  write_markdown(
      folder / "order_two.md",
      fmt::format(
          "The price of order 2, on rows of triangles without columns (chapter "
          "38). An entry has the number of unknowns, a colon, and the seconds of the "
          "active set (medians of {} runs, without mesh and assembly). The energy "
          "error is below 10, 3, 1 or 0.3 % of the energy norm of u. `>` means that "
          "the finest mesh is too coarse.",
          repeats),
      page);
}

}  // namespace antilock::tutorial
