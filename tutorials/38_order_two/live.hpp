// Behind 38_order_two.cpp: the energy error of three elements without contact, at one ε.
#include <CLI/CLI.hpp>

std::string family = "delaunay";

void errors_of_elements(const tutorial::Options& options, tutorial::Report&) {
  const std::vector<Exact> exact{exact_solution(options.epsilon, false)};
  Table rows({"element", "mesh", "cells", "h", "unknowns", "epsilon", "energy", "l2"});
  for (const Element* element : {&crouzeix_raviart(), &p2(), &hybrid_bdm1()})
    rows.add(solve_free(*element, family, options.cells, exact));
  rows.select({"element", "energy"}).write(options.out / "points.csv");
}

int figure(int argc, char** argv) {
  const auto add = [](CLI::App& line) {
    line.add_option("--mesh", family, "a family of meshes");
  };
  return tutorial::run(argc, argv, "figure_38_order_two",
                       "the errors of CR, P2 and hybrid BDM1",
                       {.epsilon = 1e-2,
                        .least_epsilon = 1e-4,
                        .cells = 8,
                        .least_cells = 8,
                        .most_cells = 16,
                        .add = add},
                       errors_of_elements);
}
