#include "common/results.hpp"

#include <fmt/format.h>

#include "antilock/analysis/lost_energy.hpp"
#include "antilock/io/writers.hpp"

namespace antilock::tutorial {

void write_results(const std::filesystem::path& out, const Space& space, const VariationalInequality& problem,
                   const Solution& solution) {
  write_msh(out / "mesh.msh", space.mesh());
  write_freefem_mesh(out / "mesh.freefem.msh", space.mesh());
  write_solution_csv(out / "solution.csv", space, solution.u);
  write_vtu(out / "solution.vtu", space, solution.u);
  if (!problem.contact.empty())
    write_csv(out / "contact.csv", {"x", "gap", "pressure"}, contact_table(space, problem, solution));
}

void print_solution(const Space& space, const VariationalInequality& problem, const Solution& solution) {
  const Counters& c = solution.counters;
  fmt::print("  {}: {} unknowns, {} contact steps, {} corrections, {} factorisation(s)\n", solution.solver, c.unknowns,
             c.contact, c.corrections, c.factorisations);
  const Kkt& k = solution.kkt;
  fmt::print(
      "  conditions (relative): smallest gap {:.1e}, smallest pressure {:.1e}, complementarity {:.1e}, residual "
      "{:.1e}\n",
      k.min_gap, k.min_pressure, k.complementarity, k.residual);
  if (!solution.warning.empty()) fmt::print("  WARNING {}\n", solution.warning);
  const ContactZone zone = contact_zone(space, problem, solution);
  if (zone.from)
    fmt::print("  contact at {} of {} points, x from {:.4f} to {:.4f}\n", zone.active, zone.points, *zone.from,
               *zone.to);
  else
    fmt::print("  contact at 0 of {} points\n", zone.points);
  const SolveSeconds& s = solution.seconds;
  fmt::print("  energy J(u) = {:.8f}; seconds: analyse {:.3f}, factor {:.3f}, contact {:.3f}, solve {:.3f}\n",
             energy(problem, solution), s.analyse, s.factor, s.contact, s.solve);
}

void print_errors(const std::string& what, const Errors& e) {
  fmt::print("  {:<36} {:>11} {:>11} {:>11} {:>11} {:>11}\n", "error against the truth", "at unknowns", "L-infinity",
             "L2", "broken H1", "energy");
  fmt::print("  {:<36} {:11.3e} {:11.3e} {:11.3e} {:11.3e} {:11.3e}\n", what, e.max_at_unknowns, e.max, e.l2, e.h1,
             e.energy);
}

void present(const std::filesystem::path& out, const Scene& scene, const Space& space,
             const VariationalInequality& problem, const Solution& solution, const std::string& what,
             const Errors& errors) {
  print_solution(space, problem, solution);
  if (const auto layer = report_layer(scene, space, problem, solution))
    fmt::print("  layer: {}\n", layer->warning.empty() ? layer->diagnosis : layer->warning);
  print_errors(what, errors);
  write_results(out, space, problem, solution);
}

}  // namespace antilock::tutorial
