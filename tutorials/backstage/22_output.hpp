#pragma once
#include "backstage/21_markdown.hpp"
#include "backstage/22_accuracies.hpp"

namespace antilock::tutorial {

/// The price list as Markdown: one row per load, epsilon and accuracy, one column per way.
inline void write_price_list(const std::filesystem::path& file, const Table& answers, const Table& uniform) {
  Table page({"load", "epsilon", "asked", "uniform", "bisected", "extruded", "midpoint stress"});
  const auto cell = [](const Table& rows) -> Entry {
    if (rows.size() == 0) return "-";
    const Table row = rows.rows().front();
    return fmt::format("{:.0f}: {:.2g} s, {:.2g}", row.number("unknowns"), row.number("seconds"), row.number("value"));
  };
  for (const Entry& load : answers.different("load"))
    for (const Entry& epsilon : answers.different("epsilon"))
      for (const Entry& asked : answers.different("asked")) {
        const auto here = [&](const Table& all) {
          return all.where("load", load).where("epsilon", epsilon).where("quantity", "bound");
        };
        const auto good = [&](double value) { return value <= asked.number(); };
        const auto way = [&](const char* name) {
          return cell(here(answers).where("asked", asked).where("method", name));
        };
        page.add({load, epsilon, asked, cell(here(uniform).where_number("value", good)), way("bisected"),
                  way("extruded"), way("midpoint")});
      }
  write_markdown(
      file,
      "Unknowns: seconds of all levels, certified relative error. Uniform: the first of gmsh's meshes that is "
      "proved good enough, without gmsh's seconds. `-`: not on the finest mesh measured; extruded at epsilon "
      "= 1 is not tried.",
      page);
}

/// The certificate of a scene on a mesh.
inline Certificate certified(const Scene& scene, const TriangleMesh& mesh) {
  const Space space(mesh, crouzeix_raviart());
  const VariationalInequality problem = assemble(scene, space);
  return certify(scene, space, problem, active_set(problem));
}

/// Prints what was asked and what it cost; writes answers.csv, price_list.csv and .md, p1.csv and the meshes of the
/// picture.
inline void show_accuracies(const std::filesystem::path& out, const Table& answers, const Table& uniform,
                            const Table& p1) {
  Table prices({"load", "epsilon", "method", "asked", "unknowns", "quoted", "seconds", "certified", "levels"});
  for (const Table& row : answers.where("quantity", "bound").rows())
    prices.add({row.entry("load"), row.entry("epsilon"), row.entry("method"), row.entry("asked"), row.entry("unknowns"),
                row.entry("quoted"), row.entry("seconds"), row.entry("value"), row.entry("levels")});
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
  for (const Growth growth : {Growth::bisect, Growth::extrude}) {
    const bool bisect = growth == Growth::bisect;
    const CertifiedSolution found =
        solve_to(scene, unstructured_mesh(8, {bisect ? 1.0 : 0.0}), {0.15, Quantity::displacement, 2e6, growth});
    write_density(out / (bisect ? "bisected.vtu" : "extruded.vtu"), *found.answer.mesh, found.certificate.indicator);
  }
}

}  // namespace antilock::tutorial
