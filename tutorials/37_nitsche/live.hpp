// Behind 37_nitsche.cpp: Γ_C for one choice of the parameters.
std::string contains = "the stiffness";

void on_contact_once(const tutorial::Options& options, tutorial::Report&) {
  const tutorial::Exact exact(tutorial::paper_scene(options.epsilon), 12);
  const Space space = columns_of(options.cells);
  const NitscheProblem columns = tutorial::nitsche_problem(exact.scene, space);
  const Choice choice{"asked", asked_gamma_0, asked_theta, contains == "the stiffness"};
  const Nitsche method = choice.method(options.epsilon, options.cells);
  const NitscheSolution solution = tutorial::solve_nitsche(columns, method);
  if (!solution.converged)
    throw NotConverged(
        fmt::format("Newton's method did not converge in {} steps", solution.steps), 1,
        solution.steps);
  const Solution strong = active_set(columns.problem);
  Table points({"x", "exact", "nitsche", "strong"});
  points.add({0.0, 0.0, 0.0, 0.0});
  for (const int i : space.contact_dofs()) {
    const double x = space.dof_coordinates()(i, 0);
    points.add({x, exact.table.value(x, -1), solution.u(i), strong.u(i)});
  }
  points.add({1.0, 0.0, 0.0, 0.0});
  points.write(options.out / "points.csv");
  const OnContact found = on_contact(space, solution.u, exact);
  const double least = tutorial::least_slope(columns, method);
  fmt::print(
      "The error is {:.3f} of the ridge, and the depth of the penetration {:.4f}. gamma is "
      "{} the bound. Newton's method took {} steps.\n",
      found.error, -found.lowest, method.slope > least ? "above" : "not above",
      solution.steps);
}

int figure(int argc, char** argv) {
  const auto add = [](CLI::App& line) {
    line.add_option("--gamma0", asked_gamma_0, "gamma_0")->check(CLI::PositiveNumber);
    line.add_option("--theta", asked_theta, "1, 0 or -1")->check(CLI::Range(-1.0, 1.0));
    line.add_option("--contains", contains, "\"the stiffness\": gamma_0 epsilon^-2 / h")
        ->check(CLI::IsMember({"the stiffness", "h alone"}));
  };
  return tutorial::run(argc, argv, "figure_37_nitsche", "Nitsche's condition on Gamma_C",
                       {.epsilon = 1e-3,
                        .least_epsilon = 1e-8,
                        .cells = 16,
                        .least_cells = 8,
                        .most_cells = 32,
                        .add = add},
                       on_contact_once);
}
