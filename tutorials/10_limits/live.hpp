// Behind 10_limits.cpp: the three models at one ε.
void compare(const tutorial::Options& options, tutorial::Report&) {
  const Table models = tutorial::three_models(options.epsilon, options.cells);
  models.write(options.out / "models.csv");
  fmt::print(
      "On Γ_C the thin layer (22) and the stretched one (23) are {:.1e} apart, the limit "
      "(25) and (23) {:.1e}.\n",
      tutorial::most_apart(models, "thin", "scaled"),
      tutorial::most_apart(models, "scaled", "limit"));
}

int figure(int argc, char** argv) {
  return tutorial::run(argc, argv, "figure_10_limits", "(22), (23) and (25) at one epsilon",
                       {.epsilon = 0.1,
                        .least_epsilon = 0.03,
                        .cells = 32,
                        .least_cells = 8,
                        .most_cells = 64},
                       compare);
}
