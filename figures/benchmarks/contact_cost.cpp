// This program compares the seconds of a contact solve with those of one unconstrained sparse
// Cholesky solve on the same mesh. It prints ratios of medians from one run, because seconds differ
// between machines and ratios hardly do. The mesh is structured with P1 at every size, and with CR
// at 1/h = 256; epsilon = 1e-6. The Cholesky solve is measured in two ways: with CHOLMOD as it
// comes, and with its loops on one thread, as the solver runs it.
//
// Run: contact_cost --out results/benchmark      two minutes on two cores
#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/standard_output.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "programs/program.hpp"
#include "unconstrained_cholesky.hpp"

// These belong to the OpenMP library that CHOLMOD is linked to, as in solve/cholmod_cholesky.cpp.
extern "C" int omp_get_max_active_levels();
extern "C" void omp_set_max_active_levels(int levels);

namespace antilock {
namespace {

/// One complete contact solution, and the measuring sticks beside it. Wall seconds.
struct Run {
  double mesh, space, assembly;  // what stands before the solver
  double solution;           // the complete contact solution: sum to K, analyse, factor, contact,
                             // corrections, report
  double residual;           // A1 u + B' M B u once: what other machines can compare
  SolveSeconds stages;       // of the solution
  CholeskySeconds cholesky;  // the measuring stick
  CholeskySeconds alike;     // the same with its loops on one thread
  int unknowns, corrections, contact;
};

Run run_once(const std::string& element_name, int cells, double epsilon, bool with_sticks) {
  Run run{};
  Stopwatch watch;
  TriangleMesh mesh = structured_mesh(cells);
  run.mesh = watch.lap();
  const Space space(std::move(mesh), element(element_name));
  run.space = watch.lap();
  const Scene scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{});
  const VariationalInequality problem = assemble(scene, space);
  run.assembly = watch.lap();
  const Solution solution = active_set(problem);
  run.solution = watch.lap();
  run.stages = solution.seconds;
  run.unknowns = solution.counters.unknowns;
  run.corrections = solution.counters.corrections;
  run.contact = solution.counters.contact_iterations;
  if (with_sticks) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(solution.u.size()),
                    strain(problem.m.size());  // its pages are touched
    watch.lap();
    sum.noalias() += problem.a1 * solution.u;
    strain = problem.m.cwiseProduct(problem.b * solution.u);
    sum.noalias() += problem.b.transpose() * strain;
    run.residual = watch.lap();
    run.cholesky = unconstrained_cholesky(problem);
    const int levels = omp_get_max_active_levels();
    omp_set_max_active_levels(0);
    run.alike = unconstrained_cholesky(problem);
    omp_set_max_active_levels(levels);
  }
  return run;
}

using Value = std::function<double(const Run&)>;

/// The value below which `part` of the runs lie: 0.5 is the median, 0.25 and 0.75 the quartiles.
double quantile(const std::vector<Run>& runs, double part, const Value& value) {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const Run& run : runs) values.push_back(value(run));
  std::sort(values.begin(), values.end());
  const double place = part * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place),
             above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in kilobytes
}

// ratios within each run, then the median: a slow moment of the machine slows both
double cost(const Run& r) { return r.solution / r.cholesky.total(); }
double alike(const Run& r) { return r.solution / r.alike.total(); }
double outside(const Run& r) {
  const double factorisation = r.stages.analyse + r.stages.factor;
  return (r.mesh + r.space + r.assembly + r.solution - factorisation) / factorisation;
}

/// The columns of the table: a median each.
const std::vector<std::pair<const char*, Value>> columns = {
    {"unknowns", [](const Run& r) { return r.unknowns; }},
    {"mesh", [](const Run& r) { return r.mesh; }},
    {"space", [](const Run& r) { return r.space; }},
    {"assembly", [](const Run& r) { return r.assembly; }},
    {"analyse", [](const Run& r) { return r.stages.analyse; }},
    {"factor", [](const Run& r) { return r.stages.factor; }},
    {"contact", [](const Run& r) { return r.stages.contact; }},
    {"solves", [](const Run& r) { return r.stages.solve; }},
    {"rest", [](const Run& r) { return r.solution - r.stages.total(); }},
    {"solution", [](const Run& r) { return r.solution; }},
    {"residual", [](const Run& r) { return r.residual; }},
    {"cholesky", [](const Run& r) { return r.cholesky.total(); }},
    {"cost", cost},
    {"alike", alike},
    {"outside", outside},
    {"corrections", [](const Run& r) { return r.corrections; }},
    {"contact_steps", [](const Run& r) { return r.contact; }}};

struct Row {
  std::string element;
  int cells;
  std::vector<Run> runs;
  double median(const Value& value) const { return quantile(runs, 0.5, value); }
  double total() const {
    return median([](const Run& r) { return r.mesh + r.space + r.assembly + r.solution; });
  }
  std::string quartiles(const Value& value) const {
    return fmt::format("{:.2f} ({:.2f} to {:.2f})", median(value), quantile(runs, 0.25, value),
                       quantile(runs, 0.75, value));
  }
};

// The targets and the measured values: they are printed, and written to targets.csv, which
// figures/benchmark reads.
struct Targets {
  std::string csv = "what,asked,measured,met\n";
  void add(const std::string& what, const std::string& asked, const std::string& measured,
           bool met) {
    fmt::print("TARGET {}: {}: {} (asked {})\n", met ? "met   " : "MISSED", what, measured, asked);
    csv += fmt::format("{},{},{},{}\n", what, asked, measured, met ? "yes" : "no");
  }
};

void benchmark(int finest, int repeats, const std::filesystem::path& folder) {
  run_once("P1", finest, 1e-6,
           false);  // first, alone: what a process needs that solves this problem and ends
  const double megabytes = peak_megabytes();

  std::vector<Row> rows;
  for (int n = 64; n <= finest; n *= 2)
    for (const std::string name : {"P1", "CR"}) {
      if (name == "CR" && n != 256) continue;
      rows.push_back({name, n, {}});
      for (int i = 0; i < repeats; ++i) rows.back().runs.push_back(run_once(name, n, 1e-6, true));
      fmt::print("{:>2} 1/h={:<4}", name, n);
      for (const auto& [column, value] : columns)
        fmt::print(" {} {:.4g}", column, rows.back().median(value));
      fmt::print("\n");
      std::fflush(stdout);
    }
  write_file(folder / "contact_cost.csv", [&](std::ostream& out) {
    out << "element,cells";
    for (const auto& [column, value] : columns) out << ',' << column;
    for (const Row& row : rows) {
      out << '\n' << row.element << ',' << row.cells;
      for (const auto& [column, value] : columns) out << fmt::format(",{:.6g}", row.median(value));
    }
    out << '\n';
  });

  int most_steps = 0;
  for (int n = 32; n <= finest; n *= 2)
    for (const double epsilon : {1.0, 1e-1, 1e-2, 1e-4, 1e-6, 0.0})
      most_steps = std::max(most_steps, run_once("P1", n, epsilon, false).contact);

  double most_outside = 0;
  bool cheap = true;
  std::string costs;
  std::vector<Row> p1;
  for (const Row& r : rows) {
    cheap = cheap && r.median(cost) <= (r.cells < 128 ? 1.4 : 1.2);
    costs += fmt::format("{}{} {}: {} and {:.2f}", costs.empty() ? "" : " / ", r.element, r.cells,
                         r.quartiles(cost), r.median(alike));
    if (r.cells >= std::min(256, finest)) most_outside = std::max(most_outside, r.median(outside));
    if (r.element == "P1") p1.push_back(r);
  }
  const Row &small = p1.front(), &large = p1.back();
  const double large_mesh = large.median([](const Run& r) { return r.mesh; });
  const int unknowns = large.runs.front().unknowns;
  Targets targets;
  targets.add(
      "contact solution over one unconstrained Cholesky solve at epsilon = 1e-6 (the quartiles) "
      "and over the same "
      "with CHOLMOD's loops on one thread",
      "<= 1.4 at 1/h = 64; <= 1.2 from 128 on", costs, cheap);
  targets.add(
      fmt::format("contact steps at the finest level; 1/h = 32 to {}; epsilon = 1 to 0", finest),
      "<= 4", fmt::format("{}", most_steps), most_steps <= 4);
  targets.add("seconds outside the factorisation over those in it; 1/h >= 256", "< 1",
              fmt::format("{:.2f}", most_outside), most_outside < 1);
  targets.add(fmt::format("structured mesh at 1/h = {}", large.cells), "well below 1 s",
              fmt::format("{:.3f} s", large_mesh), large_mesh < 0.5);
  if (p1.size() > 1) {
    const double growth = std::log(large.total() / small.total()) /
                          std::log(1.0 * unknowns / small.runs.front().unknowns);
    targets.add(fmt::format("seconds grow like a power of the unknowns; 1/h = {} to {}",
                            small.cells, large.cells),
                "<= 1.3", fmt::format("{:.2f}", growth), growth <= 1.3);
  }
  targets.add(fmt::format("peak memory at {} unknowns", unknowns), "< 1536 MB",
              fmt::format("{:.0f} MB", megabytes), megabytes < 1536);
  write_file(folder / "targets.csv", [&](std::ostream& out) { out << targets.csv; });
}

}  // namespace
}  // namespace antilock

int main(int argc, char** argv) {
  CLI::App line("The cost of contact over one unconstrained sparse Cholesky solve", "contact_cost");
  int finest = 512, repeats = 9;
  std::filesystem::path folder = "results/benchmark";
  line.add_option("--cells", finest, "finest mesh, 1/h")->check(CLI::Range(64, 1024));
  line.add_option("--repeats", repeats, "runs behind each median")->check(CLI::Range(1, 1000));
  line.add_option("--out", folder, "folder of the results");
  if (const auto status = antilock::tutorial::parse(line, argc, argv)) return *status;
  try {
    antilock::benchmark(finest, repeats, folder);
  } catch (const antilock::Error& error) {
    fmt::print(stderr, "contact_cost: {}\n", error.what());
    return 2;
  }
  return antilock::delivered(0, "contact_cost");
}
