#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "programs/report.hpp"

namespace CLI {
class App;
}

namespace antilock::tutorial {

struct Options;

/// A variation of a tutorial that `--exercise N` runs (N counts from 1). The reader
/// predicts first. The outcome claims the statements of the prediction. The page of the
/// exercise has a line `// Run: STEM --exercise N`, from which the tests are made.
struct Exercise {
  std::string question;    ///< the change, and the question about it
  std::string prediction;  ///< the answer that the outcome checks
  /// options.out is empty unless --out is given.
  std::function<void(const Options&, Report&)> outcome;
};

/// The options of every tutorial. A tutorial sets their defaults, and adds its own options
/// in `add`.
struct Options {
  double epsilon = 1e-6;     ///< the paper's epsilon, least_epsilon to 1 (dimensionless)
  double least_epsilon = 0;  ///< the smallest epsilon that the study accepts
  /// The description of --epsilon in --help.
  std::string epsilon_is = "the paper's epsilon; 0 is the rigid limit";
  /// Whether --epsilon is an option. It is false for a tutorial without an epsilon, or with
  /// its own list of them.
  bool takes_epsilon = true;
  int cells = 32;  ///< cells per unit side: h = 1/cells
  /// The least number of cells that the study needs, and the largest that it can afford.
  int least_cells = 1, most_cells = 2048;
  std::filesystem::path out = {};  ///< folder of the results; default results/STEM
  std::function<void(CLI::App&)> add = [](CLI::App&) {};
  /// The exercises of --exercise. Without any there is no such option.
  std::vector<Exercise> exercises = {};
};

/// Parses the command line, runs `body` or the requested exercise, and returns an exit
/// status: 0 if all claims hold, 1 if one fails, 2 for bad input (one line on standard
/// error), 3 if a solver did not converge (one line with the accuracy that it reached).
int run(int argc, char** argv, const std::string& stem, const std::string& what,
        Options options, const std::function<void(const Options&, Report&)>& body);

}  // namespace antilock::tutorial
