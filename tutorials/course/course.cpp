#include "course/course.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "antilock/analysis/locking_report.hpp"
#include "antilock/core/error.hpp"
#include "antilock/exact/sine_load.hpp"
#include "antilock/io/write_csv.hpp"
#include "antilock/io/write_freefem_mesh.hpp"
#include "antilock/io/write_vtu.hpp"
#include "antilock/mesh/write_msh.hpp"

namespace antilock::tutorial {
namespace {

ExactSolution known_solution(const Scene& scene, int log2_points) {
  std::optional<ExactSolution> solution = exact_solution_of(scene, log2_points);
  if (!solution)
    throw Error(
        "exact: the exact solution of this scene is not known; accepted: a StiffLayer, a "
        "load that is a sum of sines, "
        "and "
        "the obstacle, if any, at the distance 0, and nothing beyond the paper");
  return std::move(*solution);
}

void print_solution(const Result& result) {
  const Solution& solution = result.solution;
  const Counters& c = solution.counters;
  fmt::print("  {}: {} unknowns, {} contact steps, {} corrections, {} factorisation(s)\n",
             solution.solver, c.unknowns, c.contact_iterations, c.corrections,
             c.factorisations);
  const Kkt& k = solution.kkt;
  fmt::print(
      "  conditions (relative): smallest gap {:.1e}, smallest pressure {:.1e}, "
      "complementarity {:.1e}, residual "
      "{:.1e}\n",
      k.min_gap, k.min_pressure, k.complementarity, k.residual);
  if (!solution.warning.empty()) fmt::print("  WARNING {}\n", solution.warning);
  const ContactZone zone = contact_zone(result);
  const auto span =
      zone.from ? fmt::format(", x from {:.4f} to {:.4f}", *zone.from, *zone.to) : "";
  fmt::print("  contact at {} of {} points{}\n", zone.active, zone.points, span);
  const SolveSeconds& s = solution.seconds;
  fmt::print(
      "  energy J(u) = {:.8f}; seconds: analyse {:.3f}, factor {:.3f}, contact {:.3f}, "
      "solve {:.3f}\n",
      energy(result.problem, solution), s.analyse, s.factor, s.contact, s.solve);
}

}  // namespace

Scene paper_scene(double epsilon) {
  return Scene(Body{paper_load}, StiffLayer{epsilon}, UnilateralContact{});
}

Exact::Exact(Scene scene, int log2_points)
    : scene(std::move(scene)),
      epsilon(this->scene.epsilon().value_or(0)),
      solution(known_solution(this->scene, log2_points)),
      table(solution, 1 << std::clamp(log2_points - 3, 10, 14)) {}

Errors Exact::errors(const Space& space, const Solution& solution) const {
  return measure_errors(space, solution, epsilon, reference());
}

double Exact::contact_from() const {
  const auto zones = solution.contact_zones();
  return zones.empty() ? 1 : zones.front().first;
}

std::vector<Exact> exact_solutions(const std::vector<double>& epsilons, int log2_points) {
  std::vector<Exact> all;
  all.reserve(epsilons.size());
  for (const double epsilon : epsilons) all.emplace_back(paper_scene(epsilon), log2_points);
  return all;
}

void write_results(const std::filesystem::path& out, const Result& result) {
  const Space& space = result.space;
  write_msh(out / "mesh.msh", space.mesh());
  write_freefem_mesh(out / "mesh.freefem.msh", space.mesh());
  write_solution_csv(out / "solution.csv", space, result.solution.u);
  write_vtu(out / "solution.vtu", space, result.solution.u);
  if (!result.problem.bounds.unknowns.empty())
    write_csv(out / "contact.csv", {"x", "gap", "pressure"}, contact_table(result));
}

void print_errors(const std::string& what, const Errors& e) {
  Table table({"error against the truth", "at unknowns", "L-infinity", "L2", "broken H1",
               "energy"});
  table.add({what, e.max_at_unknowns, e.max, e.l2, e.h1, e.energy});
  table.print();
}

void present(const std::filesystem::path& out, const Scene& scene, const Result& result,
             const std::string& what, const Errors& errors) {
  print_solution(result);
  if (const auto layer = report_locking(scene, result))
    fmt::print("  layer: {}\n", layer->text());
  print_errors(what, errors);
  write_results(out, result);
}

Supremum supremum(const Table& runs, const std::string& value,
                  const std::string& parameter) {
  Supremum found{Table({"h", "worst", "at", "order"}), 1};
  double h_before = 0, before = 0;
  for (const TableEntry& h : runs.unique("h")) {
    const Table mesh = runs.filter("h", h);
    const double worst = mesh.max(value),
                 order = std::log(before / worst) / std::log(h_before / h.number());
    found.rows.add({h, worst, mesh.filter(value, worst).first(parameter),
                    h_before > 0 ? TableEntry(order) : TableEntry("")});
    double half = 0;
    for (int i = 0; const double here : mesh.numbers(value))
      if (i++ % 2 == 0) half = std::max(half, here);
    found.denser = std::max(found.denser, worst / half);
    h_before = h.number(), before = worst;
  }
  return found;
}

}  // namespace antilock::tutorial
