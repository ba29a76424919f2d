// What contact costs over one unconstrained sparse Cholesky solve of the same mesh: ratios within one run, medians,
// since machines differ and their ratios hardly do. P1 structured at every size, CR at 1/h = 256; epsilon = 1e-6. The
// Cholesky solve is measured twice: with CHOLMOD as it comes, and with its loops on one thread, as the solver runs it.
//
// Run: contact_cost --out results/benchmark      two minutes on two cores
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <functional>

#include "antilock/core/detail/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/solve/detail/loops_on_one_thread.hpp"
#include "benchmark/unconstrained_cholesky.hpp"
#include "common/command_line.hpp"

namespace antilock {
namespace {

// Wall seconds of the stages of one complete contact solution, and of the measuring stick beside it.
struct Run {
  double mesh, space, assembly;  // what stands before the solver
  double solution;           // the complete contact solution: sum to K, analyse, factor, contact, corrections, report
  SolveSeconds stages;       // of the solution
  CholeskySeconds cholesky;  // the measuring stick
  CholeskySeconds alike;     // the same with its loops on one thread
  int unknowns, corrections, contact;
};

Run run_once(const std::string& element_name, int cells, double epsilon, bool with_stick) {
  Run run{};
  Stopwatch watch;
  const TriangleMesh mesh = structured_mesh(cells);
  run.mesh = watch.lap();
  const Space space(mesh, element(element_name));
  run.space = watch.lap();
  const Scene scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{});
  const VariationalInequality problem = assemble(scene, space);
  run.assembly = watch.lap();
  const Solution solution = active_set(problem);
  run.solution = watch.lap();
  run.stages = solution.seconds;
  run.unknowns = solution.counters.unknowns;
  run.corrections = solution.counters.corrections;
  run.contact = solution.counters.contact;
  if (with_stick) {
    run.cholesky = unconstrained_cholesky(problem);
    const LoopsOnOneThread loops;
    run.alike = unconstrained_cholesky(problem);
  }
  return run;
}

/// The value below which `part` of the runs lie: 0.5 is the median, 0.25 and 0.75 the quartiles.
double quantile(const std::vector<Run>& runs, double part, const std::function<double(const Run&)>& value) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const Run& run : runs) values.push_back(value(run));
  std::sort(values.begin(), values.end());
  const double place = part * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place), above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in kilobytes
}

struct Row {
  std::string element;
  int cells, unknowns, corrections, contact;
  double mesh, space, assembly, sum, analyse, factor, contact_seconds, corrections_seconds, rest, solution, cholesky;
  double cost, cost_low, cost_high, outside;  // the median of the ratio and its quartiles
  double alike, alike_low, alike_high;        // the same over the Cholesky solve with its loops on one thread
  double total() const { return mesh + space + assembly + solution; }
};

Row summary(const std::string& element_name, int cells, const std::vector<Run>& runs) {
  const auto of = [&](const std::function<double(const Run&)>& value) { return quantile(runs, 0.5, value); };
  Row row{};
  row.element = element_name;
  row.cells = cells;
  row.unknowns = runs.front().unknowns;
  row.corrections = runs.front().corrections;
  row.contact = runs.front().contact;
  row.mesh = of([](const Run& r) { return r.mesh; });
  row.space = of([](const Run& r) { return r.space; });
  row.assembly = of([](const Run& r) { return r.assembly; });
  row.analyse = of([](const Run& r) { return r.stages.analyse; });
  row.factor = of([](const Run& r) { return r.stages.factor; });
  row.contact_seconds = of([](const Run& r) { return r.stages.contact; });
  row.corrections_seconds = of([](const Run& r) { return r.stages.solve; });
  row.rest = of([](const Run& r) { return r.solution - r.stages.total(); });
  row.solution = of([](const Run& r) { return r.solution; });
  row.cholesky = of([](const Run& r) { return r.cholesky.total(); });
  // ratios within each pair of runs, then the median: a slow moment of the machine slows both
  const auto cost = [](const Run& r) { return r.solution / r.cholesky.total(); };
  row.cost = quantile(runs, 0.5, cost);
  row.cost_low = quantile(runs, 0.25, cost);
  row.cost_high = quantile(runs, 0.75, cost);
  const auto alike = [](const Run& r) { return r.solution / r.alike.total(); };
  row.alike = quantile(runs, 0.5, alike);
  row.alike_low = quantile(runs, 0.25, alike);
  row.alike_high = quantile(runs, 0.75, alike);
  row.outside = of([](const Run& r) {
    const double factorisation = r.stages.analyse + r.stages.factor;
    return (r.mesh + r.space + r.assembly + r.solution - factorisation) / factorisation;
  });
  return row;
}

void print(const Row& r) {
  fmt::print(
      "{:>2} 1/h={:<4} {:>7} unknowns: mesh {:.3f} space {:.3f} assembly {:.3f} | analyse {:.3f} factor {:.3f} contact "
      "{:.3f} solves {:.3f} rest {:.3f} = {:.3f} s | Cholesky {:.3f} s | contact costs x{:.2f} ({:.2f} to {:.2f}), "
      "over the same on one thread x{:.2f} ({:.2f} to {:.2f}), outside the "
      "factorisation x{:.2f}; {} corrections, {} contact steps\n",
      r.element, r.cells, r.unknowns, r.mesh, r.space, r.assembly, r.analyse, r.factor, r.contact_seconds,
      r.corrections_seconds, r.rest, r.solution, r.cholesky, r.cost, r.cost_low, r.cost_high, r.alike, r.alike_low,
      r.alike_high, r.outside, r.corrections, r.contact);
  std::fflush(stdout);
}

void write(const std::filesystem::path& path, const std::vector<Row>& rows) {
  write_file(path, [&](std::ostream& out) {
    out << "element,cells,unknowns,mesh,space,assembly,analyse,factor,contact,solves,rest,solution,cholesky,cost,cost_"
           "low,"
           "cost_high,alike,alike_low,alike_high,outside,corrections,contact_steps\n";
    for (const Row& r : rows)
      out << fmt::format(
          "{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.4g},{:.4g},"
          "{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{},{}\n",
          r.element, r.cells, r.unknowns, r.mesh, r.space, r.assembly, r.analyse, r.factor, r.contact_seconds,
          r.corrections_seconds, r.rest, r.solution, r.cholesky, r.cost, r.cost_low, r.cost_high, r.alike, r.alike_low,
          r.alike_high, r.outside, r.corrections, r.contact);
  });
}

// What was asked for and what was measured: lines on the screen, and targets.csv for figures/benchmark.
struct Targets {
  std::string csv = "what,asked,measured,met\n";
  void add(const std::string& what, const std::string& asked, const std::string& measured, bool met) {
    fmt::print("TARGET {}: {}: {} (asked {})\n", met ? "met   " : "MISSED", what, measured, asked);
    csv += fmt::format("{},{},{},{}\n", what, asked, measured, met ? "yes" : "no");
  }
};

void benchmark(int finest, int repeats, const std::filesystem::path& folder) {
  run_once("P1", finest, 1e-6, false);  // first, alone: what a process needs that solves this problem and ends
  const double megabytes = peak_megabytes();

  std::vector<Row> rows;
  for (int n = 64; n <= finest; n *= 2)
    for (const std::string name : {"P1", "CR"}) {
      if (name == "CR" && n != 256) continue;
      std::vector<Run> runs;
      runs.reserve(repeats);
      for (int i = 0; i < repeats; ++i) runs.push_back(run_once(name, n, 1e-6, true));
      rows.push_back(summary(name, n, runs));
      print(rows.back());
    }
  write(folder / "contact_cost.csv", rows);

  int most_steps = 0;
  for (int n = 32; n <= finest; n *= 2)
    for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-4, 1e-6, 0.0})
      most_steps = std::max(most_steps, run_once("P1", n, epsilon, false).contact);

  double outside = 0;
  bool cheap = true;
  std::string costs;
  std::vector<Row> p1;
  for (const Row& r : rows) {
    cheap = cheap && r.cost <= (r.cells < 128 ? 1.4 : 1.2);
    costs += fmt::format("{}{} {}: {:.2f} ({:.2f} to {:.2f}) and {:.2f}", costs.empty() ? "" : " / ", r.element,
                         r.cells, r.cost, r.cost_low, r.cost_high, r.alike);
    if (r.cells >= std::min(256, finest)) outside = std::max(outside, r.outside);
    if (r.element == "P1") p1.push_back(r);
  }
  const Row &small = p1.front(), &large = p1.back();
  Targets targets;
  targets.add(
      "contact solution over one unconstrained Cholesky solve at epsilon = 1e-6 (the quartiles) and over the same "
      "with CHOLMOD's loops on one thread",
      "<= 1.4 at 1/h = 64; <= 1.2 from 128 on", costs, cheap);
  targets.add(fmt::format("contact steps at the finest level; 1/h = 32 to {}; epsilon = 1 to 0", finest), "<= 4",
              fmt::format("{}", most_steps), most_steps <= 4);
  targets.add("seconds outside the factorisation over those in it; 1/h >= 256", "< 1", fmt::format("{:.2f}", outside),
              outside < 1);
  targets.add(fmt::format("structured mesh at 1/h = {}", large.cells), "well below 1 s",
              fmt::format("{:.3f} s", large.mesh), large.mesh < 0.5);
  if (p1.size() > 1) {
    const double growth = std::log(large.total() / small.total()) / std::log(1.0 * large.unknowns / small.unknowns);
    targets.add(fmt::format("seconds grow like a power of the unknowns; 1/h = {} to {}", small.cells, large.cells),
                "<= 1.3", fmt::format("{:.2f}", growth), growth <= 1.3);
  }
  targets.add(fmt::format("peak memory at {} unknowns", large.unknowns), "< 1536 MB",
              fmt::format("{:.0f} MB", megabytes), megabytes < 1536);
  write_file(folder / "targets.csv", [&](std::ostream& out) { out << targets.csv; });
}

}  // namespace
}  // namespace antilock

int main(int argc, char** argv) {
  antilock::tutorial::CommandLine line("The cost of contact over one unconstrained sparse Cholesky solve",
                                       "contact_cost");
  int finest = 512, repeats = 9;
  std::filesystem::path folder = "results/benchmark";
  line.add("--cells", finest, "finest mesh, 1/h", 64, 1024);
  line.add("--repeats", repeats, "runs behind each median", 1, 1000);
  line.add("--out", folder, "folder of the results");
  if (const auto status = line.parse(argc, argv)) return *status;
  try {
    antilock::benchmark(finest, repeats, folder);
  } catch (const antilock::Error& error) {
    fmt::print(stderr, "contact_cost: {}\n", error.what());
    return 2;
  }
  return 0;
}
