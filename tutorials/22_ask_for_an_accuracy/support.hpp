#pragma once
#include <map>

#include "antilock/adapt/solve_to.hpp"
#include "antilock/certificate/exact_errors.hpp"
#include "antilock/core/stopwatch.hpp"
#include "course/certified.hpp"
#include "course/course.hpp"
#include "course/markdown.hpp"

namespace antilock::tutorial {

/// The layer in contact under a load chosen here: "paper", f = 10 sin(2 pi x), or "bump",
/// 400 exp(-r^2 / (2 0.02^2)) around (0.3, 0.6).
inline Scene load_scene(const std::string& load, double epsilon) {
  const Field bump = [](double x, double y) {
    return 400 *
           std::exp(-(std::pow(x - 0.3, 2) + std::pow(y - 0.6, 2)) / (2 * 0.02 * 0.02));
  };
  return Scene(Body{load == "bump" ? bump : Field(paper_load)}, StiffLayer{epsilon},
               UnilateralContact{});
}

/// load, epsilon, method; asked and of what; unknowns, those quoted one level before (0:
/// none), seconds of all levels; quantity ("bound": proved, "error": against the exact
/// solution) and its value, relative to |u|_a; levels; of_asked, of_quoted: value / asked,
/// unknowns / quoted; of_bound: value / bound.
inline const std::vector<std::string> accuracy_columns{
    "load",    "epsilon",  "method", "asked",  "of",       "unknowns",  "quoted",
    "seconds", "quantity", "value",  "levels", "of_asked", "of_quoted", "of_bound"};

struct Result {
  std::string load, method;
  double epsilon, asked = 0;
  Quantity of = Quantity::displacement;
  int unknowns = 0, levels = 1;
  double quoted = 0, seconds = 0, bound = 0;
};

inline std::vector<TableEntry> row(const Result& a, const std::string& quantity,
                                   double value) {
  return {a.load,
          a.epsilon,
          a.method,
          a.asked,
          a.of == Quantity::stress ? "stress" : "displacement",
          a.unknowns,
          a.quoted,
          a.seconds,
          quantity,
          value,
          a.levels,
          a.asked > 0 ? value / a.asked : 1,
          a.quoted > 0 ? a.unknowns / a.quoted : 1,
          value / a.bound};
}

/// Of |u|_a: on a cone K, |u|_a^2 = -2 J(u).
inline double relative_error(const Exact& exact, const Scene& scene, const Space& space,
                             const Solution& cr, const ConformingCompanion& v,
                             Quantity of) {
  const double norm = std::sqrt(-2 * exact.solution.energy());
  if (of == Quantity::displacement)
    return exact.errors(space, cr).energy / norm;  // of Crouzeix-Raviart: the same bound
  const VariationalInequality problem = assemble(scene, space);
  return exact_errors(space.mesh(), equilibrated_flux(scene, {space, problem, cr}), v,
                      exact.table)
             .stress /
         norm;
}

/// The bound of an answer, and for the paper's load its error.
inline Table accuracy_rows(const std::string& load, const Exact& exact,
                           const std::string& method, double asked, Quantity of,
                           const CertifiedSolution& found) {
  const RefinementLevel& last = found.history.back();
  Result result{load,
                method,
                exact.epsilon,
                asked,
                of,
                last.unknowns,
                static_cast<int>(found.history.size())};
  if (found.history.size() > 3)
    result.quoted = found.history[found.history.size() - 2].predicted_unknowns;
  result.seconds = last.seconds;
  result.bound = last.relative;
  Table rows(accuracy_columns);
  rows.add(row(result, "bound", result.bound));
  if (load != "paper") return rows;
  const ConformingCompanion v{
      .at_vertices = found.companion.u, .stress = found.companion.p, .layer = std::nullopt};
  rows.add(row(result, "error",
               relative_error(exact, load_scene(load, exact.epsilon), found.result.space,
                              found.result.solution, v, of)));
  return rows;
}

/// The price list as Markdown: one row per load, epsilon and accuracy, one column per way.
inline void write_price_list(const std::filesystem::path& file, const Table& answers,
                             const Table& uniform) {
  Table page(
      {"load", "epsilon", "asked", "uniform", "bisected", "extruded", "midpoint stress"});
  const auto cell = [](const Table& rows) -> TableEntry {
    if (rows.size() == 0) return "-";
    const Table row = rows.rows().front();
    return fmt::format("{:.0f}: {:.2g} s, {:.2g}", row.number("unknowns"),
                       row.number("seconds"), row.number("value"));
  };
  for (const TableEntry& load : answers.unique("load"))
    for (const TableEntry& epsilon : answers.unique("epsilon"))
      for (const TableEntry& asked : answers.unique("asked")) {
        const auto here = [&](const Table& all) {
          return all.filter("load", load)
              .filter("epsilon", epsilon)
              .filter("quantity", "bound");
        };
        const auto good = [&](double value) { return value <= asked.number(); };
        const auto way = [&](const char* name) {
          return cell(here(answers).filter("asked", asked).filter("method", name));
        };
        page.add({load, epsilon, asked, cell(here(uniform).filter_number("value", good)),
                  way("bisected"), way("extruded"), way("midpoint")});
      }
  write_markdown(
      file,
      "An entry has the number of unknowns, a colon, the seconds of all levels, "
      "and the certified relative error. The column `uniform` has the first mesh "
      "of gmsh that is proved to be good enough, and does not count the seconds "
      "of gmsh. `-` means that the finest mesh is too coarse. At epsilon = 1 the "
      "layer was not extruded.",
      page);
}

/// The certificate of a scene on a mesh.
inline Certificate certified(const Scene& scene, const TriangleMesh& mesh) {
  const Space space(mesh, crouzeix_raviart());
  const VariationalInequality problem = assemble(scene, space);
  return certify(scene, {space, problem, active_set(problem)});
}

/// Prints what was asked and what it cost; writes answers.csv, price_list.csv and .md,
/// p1.csv and the meshes of the picture.
inline void show_accuracies(const std::filesystem::path& out, const Table& answers,
                            const Table& uniform, const Table& p1) {
  Table prices({"load", "epsilon", "method", "asked", "unknowns", "quoted", "seconds",
                "certified", "levels"});
  for (const Table& row : answers.filter("quantity", "bound").rows())
    prices.add({row.entry("load"), row.entry("epsilon"), row.entry("method"),
                row.entry("asked"), row.entry("unknowns"), row.entry("quoted"),
                row.entry("seconds"), row.entry("value"), row.entry("levels")});
  prices.print("asked -> unknowns, seconds, certified");
  prices.write(out / "price_list.csv");
  write_price_list(out / "price_list.md", answers, uniform);
  Table all = uniform;
  all.add(answers);
  all.write(out / "answers.csv");
  p1.print("P1, refined where its bound lies");
  p1.write(out / "p1.csv");
  // a mesh of each kind, coarse enough to be seen
  const Scene scene = load_scene("bump", 1e-6);
  const TriangleMesh coarse = unstructured_mesh(16);
  write_density(out / "uniform.vtu", coarse, certified(scene, coarse).indicator);
  for (const RefinementStrategy strategy :
       {RefinementStrategy::bisect, RefinementStrategy::extrude}) {
    const bool bisect = strategy == RefinementStrategy::bisect;
    const CertifiedSolution found =
        solve_to(scene, unstructured_mesh(8, {bisect ? 1.0 : 0.0}),
                 {0.15, Quantity::displacement, 2e6, strategy});
    write_density(out / (bisect ? "bisected.vtu" : "extruded.vtu"),
                  found.result.space.mesh(), found.certificate.indicator);
  }
}

/// The certificate on gmsh's uniform meshes from 1/8 to 1/finest; the seconds add up,
/// without gmsh's own.
inline Table on_uniform_meshes(const std::string& load, const Exact& exact, int finest) {
  static std::map<int, std::shared_ptr<const TriangleMesh>>
      meshes;  // gmsh's time is not counted, nor spent twice
  const Scene scene = load_scene(load, exact.epsilon);
  Table rows(accuracy_columns);
  Result result{load, "uniform", exact.epsilon};
  for (int cells = 8; cells <= finest; cells *= 2) {
    if (!meshes.contains(cells))
      meshes[cells] = std::make_shared<const TriangleMesh>(unstructured_mesh(cells));
    Stopwatch watch;
    const Space space(meshes.at(cells), crouzeix_raviart());
    const VariationalInequality problem = assemble(scene, space);
    PenalisedCholesky factor(problem);
    const Solution solution = active_set(problem, factor);
    result.bound = certify(scene, {space, problem, solution}, {.factor = &factor})
                       .relative(Quantity::displacement);
    result.seconds += watch.lap();
    result.unknowns = space.free_count();
    rows.add(row(result, "bound", result.bound));
    if (load == "paper")
      rows.add(
          row(result, "error",
              relative_error(exact, scene, space, solution, {}, Quantity::displacement)));
  }
  return rows;
}

}  // namespace antilock::tutorial
