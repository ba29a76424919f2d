// Behind 30_friction.cpp: how much the floor rubs, times g, and what sticks.
#include <CLI/CLI.hpp>

double roughness = 1;

void rub_once(const tutorial::Options& options, tutorial::Report&) {
  const std::vector<Rubber> rubbers = tutorial::structured_rubbers(options.cells);
  const Rubber& rubber = rubbers.at(1);  // P1 on crossed triangles
  const Space x(rubber.mesh, rubber.in_x), y(x, rubber.in_y);
  const VectorSpace space{x, y};
  const auto most = [](double at) { return roughness * g(at); };
  const VariationalInequality problem = pressed(rubber, space, most, options.epsilon);
  const Solution solution = active_set(problem);
  Table floor({"x", "T", "most", "slip"}), row(tutorial::floor_columns);
  const Eigen::MatrixX3d curves = tutorial::on_floor(x, problem, solution);
  for (const auto& at : curves.rowwise()) floor.add({at(0), at(1), most(at(0)), at(2)});
  floor.write(options.out / "floor.csv");
  row.add(tutorial::floor_row(rubber, options.cells, x, problem, solution));
  const double t = row.number("T");
  fmt::print(
      "It sticks on {:.2f} of the floor. The floor pulls the left half {} with {:.4f}; the "
      "left half slips by {:.4f} "
      "at most.\n",
      row.number("sticks"), t > 0 ? "to the right" : "to the left", std::abs(t),
      std::abs(row.number("slip")));
}

int figure(int argc, char** argv) {
  const auto add = [](CLI::App& line) {
    line.add_option("--rough", roughness, "times g")->check(CLI::Range(0.0, 4.0));
  };
  return tutorial::run(
      argc, argv, "figure_30_friction", "stick and slip",
      {.epsilon = 1e-8, .cells = 32, .least_cells = 8, .most_cells = 64, .add = add},
      rub_once);
}
