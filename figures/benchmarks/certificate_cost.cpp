// This program measures two ratios of seconds. The first is the cost of a certificate over the
// solve that it certifies. The second is the gain of an adapted mesh, with the time of all its
// levels counted. Both times of a ratio come from one run, because seconds differ between machines
// and ratios hardly do. Each ratio is that of the medians of some repeats.
//
// Run: certificate_cost                               1/h = 128, three repeats; half a minute
// Run: certificate_cost --cells 64 --repeats 1
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>

#include "antilock/adapt/solve_to.hpp"
#include "antilock/analysis/locking_report.hpp"
#include "antilock/core/standard_output.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"
#include "antilock/study/table.hpp"
#include "programs/program.hpp"

namespace antilock {
namespace {

double bump(double x, double y) {
  return 400 * std::exp(-(std::pow(x - 0.3, 2) + std::pow(y - 0.6, 2)) / (2 * 0.02 * 0.02));
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

struct Seconds {
  std::vector<double> solve, flux, strip, rest;

  void measure(const Scene& scene, const TriangleMesh& mesh) {
    const Space space(mesh, crouzeix_raviart());
    Stopwatch watch;
    Result result{space, assemble(scene, space)};
    PenalisedCholesky factor(result.problem);
    result.solution = active_set(result.problem, factor);
    solve.push_back(watch.lap());
    equilibrated_flux(scene, result);
    flux.push_back(watch.lap());
    const ConformingCompanion v = local_companion(scene, result);
    strip.push_back(watch.lap());
    certify(scene, result, {.factor = &factor, .companion = &v});  // makes the flux once more
    rest.push_back(watch.lap());
  }
};

/// A row as soon as it is measured, into a pipe or a file as well.
void row(Table& table, const std::string& what, double asked, double measured) {
  fmt::print("{}: asked {:g}, measured {:.3f}\n", what, asked, measured);
  std::fflush(stdout);
  table.add({what, asked, std::round(1e4 * measured) / 1e4});
}

void certificate_over_solve(Table& table, int cells, int repeats) {
  const TriangleMesh mesh = unstructured_mesh(cells);
  for (const double epsilon : {1e-2, 1e-6, 0.0}) {
    Seconds seconds;
    for (int k = 0; k < repeats; ++k)
      seconds.measure(Scene({paper_load}, StiffLayer{epsilon}, UnilateralContact{}), mesh);
    const double solve = median(seconds.solve), flux = median(seconds.flux),
                 strip = median(seconds.strip);
    const std::string at = fmt::format("1/h = {}; epsilon = {:g}", cells, epsilon);
    row(table, "flux and strip over the CR solve; " + at, 0.1, (flux + strip) / solve);
    fmt::print("  the whole certificate over the CR solve: {:.3f}; the solve: {:.3f} s\n",
               (strip + median(seconds.rest)) / solve, solve);
  }
}

/// What a P1 answer says of its own locking, over its solve (15 % are asked at every size).
void diagnosis_over_solve(Table& table, int cells, int repeats) {
  const Space space(unstructured_mesh(cells), p1());
  const Scene scene({paper_load}, StiffLayer{1e-2}, UnilateralContact{});
  Result result{space, assemble(scene, space)};
  std::vector<double> solve, diagnosis;
  auto of_processor =
      [last =
           std::clock()]() mutable {  // a few milliseconds each at 1/h = 32: other programs would
        const std::clock_t now = std::clock();  // stand in wall seconds
        return static_cast<double>(now - std::exchange(last, now));
      };
  for (int k = 0; k < 5 * repeats * (128 / std::min(cells, 128)); ++k) {
    of_processor();
    result.solution = active_set(result.problem);
    solve.push_back(of_processor());
    report_locking(scene, result);
    diagnosis.push_back(of_processor());
  }
  row(table, fmt::format("diagnosis of locking over the P1 solve; 1/h = {}", cells), 0.15,
      median(diagnosis) / median(solve));
}

/// Bump at 3 %: solve_to against a uniform mesh that is proved as good, gmsh's time not counted.
/// The uniform mesh's seconds are those of 2 `cells`, extrapolated by its unknowns: they grow at
/// least like that.
void adapted_over_uniform(Table& table, int cells, int repeats) {
  constexpr double asked = 3e-2;
  const Scene scene({bump}, StiffLayer{1e-6}, UnilateralContact{});
  std::vector<double> adapted, uniform;
  int unknowns = 0, uniform_unknowns = 0;
  const TriangleMesh mesh = unstructured_mesh(2 * cells);
  for (int k = 0; k < repeats; ++k) {
    const CertifiedSolution found = solve_to(scene, unstructured_mesh(8, {0}), {asked});
    adapted.push_back(found.history.back().seconds);
    unknowns = found.history.back().unknowns;
    const Space space(mesh, crouzeix_raviart());
    Stopwatch watch;
    Result result{space, assemble(scene, space)};
    PenalisedCholesky factor(result.problem);
    result.solution = active_set(result.problem, factor);
    const double relative =
        certify(scene, result, {.factor = &factor}).relative(Quantity::displacement);
    const double times = std::pow(relative / asked, 2);
    uniform.push_back(watch.lap() * times);
    uniform_unknowns = static_cast<int>(space.free_count() * times);
  }
  row(table, "seconds to a proved 3 % of the concentrated load; adapted over uniform", 0.25,
      median(adapted) / median(uniform));
  fmt::print("  adapted: {} unknowns, {:.2f} s in all; uniform: about {} unknowns, {:.2f} s\n",
             unknowns, median(adapted), uniform_unknowns, median(uniform));
}

}  // namespace
}  // namespace antilock

int main(int argc, char** argv) {
  int cells = 128, repeats = 3;
  std::filesystem::path out;
  CLI::App line("What a certificate costs, and what an adapted mesh saves", "certificate_cost");
  line.add_option("--cells", cells, "1/h of the uniform mesh")->check(CLI::Range(16, 256));
  line.add_option("--repeats", repeats, "runs behind each median")->check(CLI::Range(1, 100));
  line.add_option("--out", out, "a table of what was asked and measured, CSV");
  if (const auto status = antilock::tutorial::parse(line, argc, argv)) return *status;
  antilock::Table table({"what", "asked", "measured"});
  antilock::certificate_over_solve(table, cells, repeats);
  for (const int n : {32, cells}) antilock::diagnosis_over_solve(table, n, repeats);
  antilock::adapted_over_uniform(table, cells, repeats);
  if (!out.empty()) table.write(out);
  return antilock::delivered(0, "certificate_cost");
}
