// Behind 22_ask_for_an_accuracy.cpp: one accuracy, the levels on the way to it, the mesh in
// the end.
#include <CLI/CLI.hpp>

double asked = 0.1;
std::string load = "bump", quantity = "displacement";

void ask_once(const tutorial::Options& options, tutorial::Report&) {
  const RefinementStrategy strategy =
      options.epsilon > 0.1 ? RefinementStrategy::bisect : RefinementStrategy::extrude;
  Table levels({"unknowns", "bound"}),
      triangles({"x0", "y0", "x1", "y1", "x2", "y2", "colour"});
  const CertifiedSolution found =
      solve_to(load_scene(load, options.epsilon), first_mesh(strategy),
               {asked, quantity == "stress" ? Quantity::stress : Quantity::displacement,
                2e6, strategy},
               [&](const RefinementLevel& level) {
                 levels.add({level.unknowns, level.relative});
               });
  levels.write(options.out / "levels.csv");
  const TriangleMesh& mesh = found.result.space.mesh();
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    std::vector<TableEntry> row;
    for (const int v : mesh.triangles.row(t))
      row.insert(row.end(), {mesh.vertices(v, 0), mesh.vertices(v, 1)});
    row.emplace_back(
        std::log10(std::max(found.certificate.indicator(t) / mesh.area(t), 1e-12)));
    triangles.add(row);
  }
  triangles.write(options.out / "triangles.csv");
  fmt::print("Asked {:g} %, proved {:.2f} % with {} unknowns, on {} meshes.\n", 100 * asked,
             100 * levels.last("bound"), levels.last("unknowns"), levels.size());
}

int figure(int argc, char** argv) {
  const auto add = [](CLI::App& line) {
    line.add_option("--asked", asked, "relative accuracy asked for")
        ->check(CLI::Range(0.02, 0.2));
    line.add_option("--load", load, "paper or bump");
    line.add_option("--of", quantity, "displacement or stress");
  };
  return tutorial::run(argc, argv, "figure_22_ask_for_an_accuracy", "one accuracy",
                       {.epsilon = 1e-6, .add = add}, ask_once);
}
