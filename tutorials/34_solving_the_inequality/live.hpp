// Behind 34_solving_the_inequality.cpp: one guess of the active set and one step of
// proximal Galerkin for P1, and how many each of them needs.
#include <CLI/CLI.hpp>
#include <optional>

std::string family = "structured";
int step = 1;  // from 1; a method that has ended shows its last one

/// Runs proximal Galerkin. Returns nothing, and prints its refusal, where it finds no
/// solution.
std::optional<Found> proximal_or_refusal(const OnContact& p) {
  try {
    return proximal_by_hand(p);
  } catch (const NotConverged& refusal) {
    fmt::print("Proximal Galerkin is refused: {}.", refusal.what());
    return std::nullopt;
  }
}

void two_ways(const tutorial::Options& options, tutorial::Report&) {
  const Space space = Method{&p1(), mesh_family(family)}.space(options.cells);
  const VariationalInequality problem =
      assemble(tutorial::paper_scene(options.epsilon), space);
  const OnContact p = tutorial::condense(problem);
  const std::vector<bool> nothing(p.w.size(), false);
  const Found guesses = semismooth_newton(p, nothing);
  fmt::print("The active set ends with guess {}. ", guesses.steps);
  const std::optional<Found> steps = proximal_or_refusal(p);
  if (steps)
    fmt::print("Proximal Galerkin ends with proximal step {}, after {} Newton steps.",
               steps->outer, steps->steps);
  fmt::print("\n");
  const auto shown = [](const Found& found) {
    const std::size_t last = found.shapes.size();
    return found.shapes.at(std::min<std::size_t>(step, last) - 1);
  };
  Table curves({"x", "guess", "proximal", "answer"});
  for (int i = 0; i < p.w.size(); ++i) {
    const double x = space.dof_coordinates()(problem.bounds.unknowns[i], 0);
    curves.add({x, shown(guesses)(i), steps ? shown(*steps)(i) : 0.0, guesses.s(i)});
  }
  curves.write(options.out / "curves.csv");
}

int figure(int argc, char** argv) {
  const auto add = [](CLI::App& line) {
    line.add_option("--mesh", family, "a family of meshes");
    line.add_option("--step", step, "the guess or the proximal step that is shown")
        ->check(CLI::Range(1, 100));
  };
  return tutorial::run(
      argc, argv, "figure_34_solving_the_inequality", "two ways to one answer",
      {.epsilon = 0, .cells = 32, .least_cells = 4, .most_cells = 64, .add = add},
      two_ways);
}
