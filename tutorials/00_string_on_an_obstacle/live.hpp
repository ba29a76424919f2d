// Behind 00_string_on_an_obstacle.cpp: each guess of the active set.
void step_by_step(const tutorial::Options& options, tutorial::Report&) {
  const String s = hang(options.cells);
  std::vector<VectorXd> guesses;
  active_set_by_hand(s, guesses);
  Table steps({"step", "x", "u", "pressure", "held"}), counts({"active set"});
  for (std::size_t k = 0; k < guesses.size(); ++k) {
    const VectorXd &u = guesses[k], missing = s.a * u - s.b;
    for (int i = 0; i < u.size(); ++i) {
      const bool held = k > 0 && u(i) == s.floor(i);
      steps.add({k, (i + 1) * s.h, u(i), held ? missing(i) / s.h : 0.0, held});
    }
  }
  counts.add({guesses.size()});
  steps.write(options.out / "steps.csv");
  counts.write(options.out / "counts.csv");
  fmt::print("The active set is done after {} linear solves.\n", guesses.size());
}

int figure(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "figure_00_string_on_an_obstacle", "active set, step by step",
      {.takes_epsilon = false, .least_cells = 4, .most_cells = 64}, step_by_step);
}
