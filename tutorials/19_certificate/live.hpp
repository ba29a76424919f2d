// Behind 19_certificate.cpp: the proved bound and the error at one ε.
#include <CLI/CLI.hpp>

std::string family = "unstructured";

void bound(const tutorial::Options& options, tutorial::Report&) {
  certify_both(mesh_family(family), options.cells,
               tutorial::exact_solutions({options.epsilon}, 14))
      .select({"element", "bound", "error"})
      .write(options.out / "points.csv");
}

int figure(int argc, char** argv) {
  const auto add = [](CLI::App& line) {
    line.add_option("--mesh", family, "a family of meshes");
  };
  return tutorial::run(
      argc, argv, "figure_19_certificate", "a proved bound, and the error",
      {.epsilon = 1, .cells = 8, .least_cells = 8, .most_cells = 32, .add = add}, bound);
}
