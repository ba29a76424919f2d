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

/// A variation of a tutorial that `--exercise N` runs (N counts from 1). The reader predicts first; the outcome claims
/// what the prediction says. Its page has a line `// Run: STEM --exercise N`, from which the tests are made.
struct Exercise {
  std::string question;                                  ///< what is changed, and what is asked
  std::string prediction;                                ///< the answer that the outcome checks
  std::function<void(const Options&, Report&)> outcome;  ///< options.out is empty unless --out was given
};

/// The options that every tutorial understands. Set the defaults, and `add` options of one tutorial's own.
struct Options {
  double epsilon = 1e-6;     ///< the paper's epsilon, least_epsilon to 1 (dimensionless)
  double least_epsilon = 0;  ///< the smallest that the study accepts
  std::string epsilon_is = "the paper's epsilon; 0 is the rigid limit";  ///< in --help
  bool takes_epsilon = true;  ///< false where it has none, or studies its own: --epsilon is not offered then
  int cells = 32;             ///< cells per unit side: h = 1/cells
  int least_cells = 1, most_cells = 2048;  ///< what the study needs, and can afford
  std::filesystem::path out = {};          ///< folder of the results; default results/STEM
  std::function<void(CLI::App&)> add = [](CLI::App&) {};
  std::vector<Exercise> exercises = {};  ///< what --exercise accepts; not offered where there are none
};

/// Parses the command line, runs `body` or the exercise asked for, and turns the outcome into an exit status: 0 all
/// claims hold, 1 one fails, 2 bad input (one line on standard error), 3 a solver did not converge (one line that says
/// how far it came).
int run(int argc, char** argv, const std::string& stem, const std::string& what, Options options,
        const std::function<void(const Options&, Report&)>& body);

}  // namespace antilock::tutorial
