// Behind 35_interior_penalty.cpp: Γ_C by both penalties at one ε, on a mesh that needs no
// gmsh.
std::string family = "staggered";

void on_contact(const tutorial::Options& options, tutorial::Report&) {
  const Scene scene = tutorial::paper_scene(options.epsilon);
  const tutorial::Exact exact(scene, 12);
  const Space space = whole_jump.space(mesh_family(family).mesh(options.cells));
  const Eigen::VectorXd whole = active_set(whole_jump.problem(scene, space)).u;
  const Eigen::VectorXd mean = active_set(mean_jump.problem(scene, space)).u;
  Table points({"x", "exact", "whole", "mean"});
  for (const int i : space.contact_dofs()) {
    const double x = space.dof_coordinates()(i, 0);
    points.add({x, exact.table.value(x, -1), whole(i), mean(i)});
  }
  points.write(options.out / "points.csv");
  const double height = exact.solution.max_on_contact();
  fmt::print(
      "{:.3f} of the ridge is kept if the whole jump is penalised, and {:.3f} if its mean "
      "is.\n",
      points.max("whole") / height, points.max("mean") / height);
}

int figure(int argc, char** argv) {
  const auto add = [](CLI::App& line) {
    line.add_option("--mesh", family, "a family of meshes");
    line.add_option("--gamma", gamma_of_run, "penalty parameter, above 1")
        ->check(CLI::PositiveNumber);
  };
  return tutorial::run(
      argc, argv, "figure_35_interior_penalty", "the ridge by two penalties",
      {.epsilon = 1e-2, .cells = 8, .least_cells = 4, .most_cells = 16, .add = add},
      on_contact);
}
