// Behind 00_string_on_an_obstacle.cpp: every guess of the active set, and as many steps of
// Uzawa beside it.
void step_by_step(const tutorial::Options& options, tutorial::Report&) {
  const String s = hang(options.cells);
  std::vector<VectorXd> guesses, shapes;
  active_set_by_hand(s, guesses);
  const Result uzawa = uzawa_by_hand(s, 1.9 * pi * pi * s.h, 1e-10, &shapes);
  Table steps({"step", "x", "u", "pressure", "held", "uzawa"}),
      counts({"active set", "Uzawa"});
  for (std::size_t k = 0; k < guesses.size(); ++k) {
    const VectorXd &u = guesses[k], &beside = shapes[std::min(k, shapes.size() - 1)],
                   missing = s.a * u - s.b;
    for (int i = 0; i < u.size(); ++i) {
      const bool held = k > 0 && u(i) == s.floor;
      steps.add({k, (i + 1) * s.h, u(i), held ? missing(i) / s.h : 0.0, held, beside(i)});
    }
  }
  counts.add({guesses.size(), uzawa.solves});
  steps.write(options.out / "steps.csv");
  counts.write(options.out / "counts.csv");
  fmt::print("The active set is done after {} linear solves, Uzawa after {}.\n",
             guesses.size(), uzawa.solves);
}

int figure(int argc, char** argv) {
  return tutorial::run(
      argc, argv, "figure_00_string_on_an_obstacle", "active set and Uzawa, step by step",
      {.takes_epsilon = false, .least_cells = 4, .most_cells = 64}, step_by_step);
}
