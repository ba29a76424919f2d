// Behind 39_three_dimensions.cpp: the share of the energy that P1 and Crouzeix-Raviart keep,
// at one ε and without an obstacle.
#include <CLI/CLI.hpp>

std::string family_of_figure = "unstructured";

void shares_kept(const tutorial::Options& options, tutorial::Report&) {
  const std::vector<ExactWithoutObstacle> exact{ExactWithoutObstacle(options.epsilon)};
  Table rows({"element", "kept"});
  for (const Element* element : {&affine, &cr})
    rows.add(solve_free(*element, family_of_figure, options.cells, exact)
                 .select({"element", "kept"}));
  rows.write(options.out / "points.csv");
}

int figure(int argc, char** argv) {
  const auto add = [](CLI::App& line) {
    line.add_option("--mesh", family_of_figure, "a family of meshes")
        ->check(CLI::IsMember(families));
  };
  return tutorial::run(argc, argv, "figure_39_three_dimensions",
                       "the share of the energy that is kept in space",
                       {.epsilon = 1e-2,
                        .least_epsilon = 1e-4,
                        .cells = 6,
                        .least_cells = 4,
                        .most_cells = 6,
                        .add = add},
                       shares_kept);
}
