// Behind 26_elasticity.cpp: the contact force of each discretisation at one λ.
void press(const tutorial::Options& options, tutorial::Report&) {
  Table forces({"element", "force"});
  for (const Rubber& rubber : tutorial::rubbers(options.cells)) {
    const Space x(rubber.mesh, rubber.in_x), y(x, rubber.in_y);
    Sweep sweep(pushed(rubber, {x, y}, 1));
    sweep.set_compliance(options.epsilon);
    forces.add({rubber.name, sweep.solve().lambda.sum()});
  }
  forces.write(options.out / "points.csv");
}

int figure(int argc, char** argv) {
  return tutorial::run(argc, argv, "figure_26_elasticity", "the contact force",
                       {.epsilon = 1, .cells = 8, .least_cells = 8, .most_cells = 32},
                       press);
}
