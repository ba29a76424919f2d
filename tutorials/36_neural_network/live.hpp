// Behind 36_neural_network.cpp: the energy of three networks with random weights at one ε.
#include <CLI/CLI.hpp>

int feature_count = 50, draw_number = 1;

void networks(const tutorial::Options& options, tutorial::Report&) {
  const ExactSolution exact = without_obstacle(options.epsilon);
  const double stiffness = std::pow(options.epsilon, -2);
  const Network any = draw(feature_count, false, draw_number);
  const Network half = draw(feature_count, true, draw_number);
  const Share any_share = share(ritz(any, options.cells), stiffness, exact);
  const Share half_share = share(ritz(half, options.cells), stiffness, exact);
  const Share true_share = share(ritz(any, options.cells, options.epsilon), 1, exact);
  Table rows({"network", "energy", "ridge"});
  rows.add({"any weights", any_share.energy, any_share.ridge});
  rows.add({"half of them columns", half_share.energy, half_share.ridge});
  rows.add({"true coordinate", true_share.energy, true_share.ridge});
  rows.write(options.out / "points.csv");
}

int figure(int argc, char** argv) {
  tutorial::Options options{.epsilon = 1e-2, .least_epsilon = 1e-5, .cells = 20};
  options.least_cells = 12;
  options.most_cells = 64;
  options.add = [](CLI::App& line) {
    const CLI::Range counts(10, 100), draws(1, 1000);
    line.add_option("--features", feature_count, "of the network")->check(counts);
    line.add_option("--draw", draw_number, "the seed of the weights")->check(draws);
  };
  const std::string about = "the energy of networks with random weights";
  return tutorial::run(argc, argv, "figure_36_neural_network", about, options, networks);
}
