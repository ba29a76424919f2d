// Measures the cost of bounds on all unknowns: a membrane over an obstacle, on the Schur complement
// and on the sparse matrix. Finds the number of bounds at which the two cost the same
// (ContactReduction, solve/penalised_cholesky.hpp).
//
// Run: many_bounds --out results/benchmark                 half a minute: the table, to 1/h = 512
// Run: many_bounds --crossover --out results/benchmark     bounds on k rows of the vertices instead: 20 s
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/standard_output.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/solve/active_set.hpp"
#include "programs/program.hpp"
#include "support/membrane.hpp"

namespace antilock {
namespace {

struct Measured {
  double seconds = 0;  // median of three
  Counters counters;
};

Measured measure(const VariationalInequality& problem, ContactReduction reduction) {
  Measured measured;
  std::vector<double> seconds;
  ActiveSetOptions options;
  options.reduction = reduction;
  for (int run = 0; run < 3; ++run) {
    const Stopwatch watch;
    measured.counters = active_set(problem, options).counters;
    seconds.push_back(watch.seconds());
  }
  std::sort(seconds.begin(), seconds.end());
  measured.seconds = seconds[1];
  return measured;
}

/// The Schur complement up to 2,000 bounds: beyond it grows by eight where they double.
void table(int finest, const std::filesystem::path& folder) {
  std::string csv = "bounds,dense,sparse,contact_steps,factorisations\n";
  for (const int n : {16, 24, 32, 45, 64, 128, 256, 512}) {
    if (n > finest) break;
    const VariationalInequality problem = test::membrane_over_obstacle(n);
    const Measured sparse = measure(problem, ContactReduction::sparse);
    const std::string dense =
        n > 45
            ? ""
            : fmt::format("{:.3g}", measure(problem, ContactReduction::schur_complement).seconds);
    fmt::print("{:>7} bounds: dense {:>6} s, sparse {:.3g} s in {} steps, {} factorisations\n",
               problem.size(), dense, sparse.seconds, sparse.counters.contact_iterations,
               sparse.counters.factorisations);
    std::fflush(stdout);
    csv += fmt::format("{},{},{:.4g},{},{}\n", problem.size(), dense, sparse.seconds,
                       sparse.counters.contact_iterations, sparse.counters.factorisations);
  }
  write_file(folder / "many_bounds.csv", [&](std::ostream& out) { out << csv; });
}

void crossover(const std::filesystem::path& folder) {
  std::string csv = "unknowns,bounds,rows,dense,sparse\n";
  for (const int n : {32, 64, 128})
    for (const int rows : {1, 2, 4, 6, 8, 10, 12}) {
      VariationalInequality problem = test::membrane_over_obstacle(n);
      const int m = n - 1, first = (m - rows) / 2 * m;
      const auto begin = problem.bounds.unknowns.begin() + first;
      problem.bounds = Bounds::lower_on({begin, begin + rows * m},
                                        problem.bounds.lower.segment(first, rows * m));
      const double dense = measure(problem, ContactReduction::schur_complement).seconds;
      const double sparse = measure(problem, ContactReduction::sparse).seconds;
      fmt::print(
          "{:>6} unknowns, {:>5} bounds = {:>2} sqrt(F): dense {:.3g} s, sparse {:.3g} s, dense "
          "over sparse {:.2f}\n",
          problem.size(), problem.bounds.unknowns.size(), rows, dense, sparse, dense / sparse);
      std::fflush(stdout);
      csv += fmt::format("{},{},{},{:.4g},{:.4g}\n", problem.size(), problem.bounds.unknowns.size(),
                         rows, dense, sparse);
    }
  write_file(folder / "crossover.csv", [&](std::ostream& out) { out << csv; });
}

}  // namespace
}  // namespace antilock

int main(int argc, char** argv) {
  CLI::App line("The cost of bounds on all unknowns", "many_bounds");
  int finest = 512;
  bool rows = false;
  std::filesystem::path folder = "results/benchmark";
  line.add_option("--cells", finest, "finest mesh, 1/h")->check(CLI::Range(16, 512));
  line.add_flag("--crossover", rows,
                "bounds on a few rows of vertices, to see where the two reductions cost the same");
  line.add_option("--out", folder, "folder of the results");
  if (const auto status = antilock::tutorial::parse(line, argc, argv)) return *status;
  try {
    if (rows)
      antilock::crossover(folder);
    else
      antilock::table(finest, folder);
  } catch (const antilock::Error& error) {
    fmt::print(stderr, "many_bounds: {}\n", error.what());
    return 2;
  }
  return antilock::delivered(0, "many_bounds");
}
