// Behind 16_degree.cpp: how much of the ridge each degree keeps at one ε.
#include <CLI/CLI.hpp>

std::string family = "unstructured";

void degrees(const tutorial::Options& options, tutorial::Report&) {
  const Exact exact(tutorial::paper_scene(options.epsilon), 12);
  Table rows(names);
  for (const Method& method : methods({&p1(), &p2(), &p3(), &p4()}, {mesh_family(family)}))
    rows.add(solve(method, options.cells, options.epsilon, paper_load, exact));
  rows.select({"element", "kept", "law"}).write(options.out / "points.csv");
}

int figure(int argc, char** argv) {
  const auto add = [](CLI::App& line) {
    line.add_option("--mesh", family, "a family of meshes");
  };
  return tutorial::run(argc, argv, "figure_16_degree", "the ridge that degrees 1 to 4 keep",
                       {.epsilon = 1e-2,
                        .least_epsilon = 1e-4,
                        .cells = 8,
                        .least_cells = 8,
                        .most_cells = 16,
                        .add = add},
                       degrees);
}
