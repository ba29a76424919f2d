// What a certificate costs over the solve that it certifies, and what an adapted mesh saves, all levels paid for:
// ratios within one run, the least of three, since machines differ and their ratios hardly do.
//
// Run: certificate_cost                      half a minute on two cores
#include <fmt/format.h>

#include <algorithm>

#include "antilock/adapt/solve_to.hpp"
#include "antilock/core/stopwatch.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/models/anti_plane.hpp"
#include "antilock/solve/active_set.hpp"

namespace antilock {
namespace {

double bump(double x, double y) {
  return 400 * std::exp(-(std::pow(x - 0.3, 2) + std::pow(y - 0.6, 2)) / (2 * 0.02 * 0.02));
}

struct Seconds {
  double solve, flux, strip, certificate;
};

Seconds once(const Scene& scene, const TriangleMesh& mesh) {
  const Space space(mesh, crouzeix_raviart());
  Stopwatch watch;
  const VariationalInequality problem = assemble(scene, space);
  PenaltyFactor factor(problem);
  const Solution solution = active_set(problem, factor);
  Seconds seconds{};
  seconds.solve = watch.lap();
  equilibrated_flux(scene, space, problem, solution);
  seconds.flux = watch.lap();
  const Companion v = strip_companion(scene, space, problem, solution);
  seconds.strip = watch.lap();
  certify(scene, space, problem, solution, {.factor = &factor, .companion = &v});
  seconds.certificate = seconds.strip + watch.lap();
  return seconds;
}

void certificate_over_solve() {
  fmt::print("{:>5} {:>8} {:>10} {:>16} {:>12}\n", "1/h", "epsilon", "solve, s", "flux + strip, %", "in all, %");
  for (const int cells : {128, 256})
    for (const double epsilon : {1e-2, 1e-6, 0.0}) {
      const TriangleMesh mesh = unstructured_mesh(cells);
      Seconds least{1e9, 1e9, 1e9, 1e9};
      for (int repeat = 0; repeat < 3; ++repeat) {
        const Seconds now = once(Scene({paper_load}, StiffLayer{epsilon}, UnilateralContact{}), mesh);
        least = {std::min(least.solve, now.solve), std::min(least.flux, now.flux), std::min(least.strip, now.strip),
                 std::min(least.certificate, now.certificate)};
      }
      fmt::print("{:>5} {:>8g} {:>10.3f} {:>16.1f} {:>12.1f}\n", cells, epsilon, least.solve,
                 100 * (least.flux + least.strip) / least.solve, 100 * least.certificate / least.solve);
    }
}

/// Bump at 3 %: solve_to against the coarsest uniform mesh that is proved as good, gmsh's time not counted.
void adapted_over_uniform() {
  const Scene scene({bump}, StiffLayer{1e-6}, UnilateralContact{});
  double adapted = 1e9;
  int unknowns = 0;
  for (int repeat = 0; repeat < 3; ++repeat) {
    const CertifiedSolution found = solve_to(scene, unstructured_mesh(8, {0}), {3e-2});
    adapted = std::min(adapted, found.history.back().seconds);
    unknowns = found.history.back().unknowns;
  }
  const TriangleMesh mesh = unstructured_mesh(256);
  const Space space(mesh, crouzeix_raviart());
  Stopwatch watch;
  const VariationalInequality problem = assemble(scene, space);
  PenaltyFactor factor(problem);
  const Solution solution = active_set(problem, factor);
  const double relative =
      certify(scene, space, problem, solution, {.factor = &factor}).relative(Quantity::displacement);
  const double uniform = watch.seconds() * std::pow(relative / 3e-2, 2);  // the seconds grow at least like the unknowns
  fmt::print(
      "bump, 3 %: adapted {} unknowns, {:.2f} s in all; uniform about {:.0f} unknowns, {:.2f} s: a share of {:.2f}\n",
      unknowns, adapted, space.free_count() * std::pow(relative / 3e-2, 2), uniform, adapted / uniform);
}

}  // namespace
}  // namespace antilock

int main() {
  antilock::certificate_over_solve();
  antilock::adapted_over_uniform();
}
