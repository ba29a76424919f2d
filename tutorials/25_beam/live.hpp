// Behind 25_beam.cpp: one beam with both integrations.
void bend_both(const tutorial::Options& options, tutorial::Report&) {
  const Beam full{
      .cells = options.cells, .epsilon = options.epsilon, .shear = ShearIntegration::full};
  const Beam reduced{.cells = options.cells,
                     .epsilon = options.epsilon,
                     .shear = ShearIntegration::reduced};
  const Solution locked = active_set(assemble(full)), good = active_set(assemble(reduced));
  tutorial::draw_beam(reduced, locked, good).write(options.out / "beam.csv");
  const double h = 1.0 / options.cells;
  fmt::print(
      "Full integration is {} too stiff. The error of w is {:.2g} with it, and {:.2g} with "
      "reduced integration.\n",
      options.epsilon > 0 ? fmt::format("{:.4g} times", 1 + h * h / (12 * options.epsilon))
                          : "infinitely",
      error_of_w(full, locked.u), error_of_w(reduced, good.u));
}

int figure(int argc, char** argv) {
  return tutorial::run(argc, argv, "figure_25_beam", "one beam with both integrations",
                       {.epsilon = 1e-4, .cells = 16, .least_cells = 8, .most_cells = 64},
                       bend_both);
}
