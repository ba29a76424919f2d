#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "antilock/core/stopwatch.hpp"
#include "common/command_line.hpp"

namespace antilock::tutorial {

/// The options that every tutorial understands. Set the defaults, and `add` options of one tutorial's own.
struct Options {
  double epsilon = 1e-6;      ///< the paper's epsilon, least_epsilon to 1 (dimensionless)
  double least_epsilon = 0;   ///< what the study can do with
  bool takes_epsilon = true;  ///< false where it has none, or studies its own: --epsilon is not offered then
  int cells = 32;             ///< cells a unit side: h = 1/cells
  int least_cells = 1, most_cells = 2048;  ///< what the study needs, and can afford
  std::filesystem::path out;               ///< folder of the results; default results/STEM
  std::function<void(CommandLine&)> add = [](CommandLine&) {};
};

/// What a tutorial says while it runs: stages with their seconds, and the verdict at its end.
class Report {
 public:
  /// Prints what is being done now; the seconds of the stage before are printed when the next begins.
  void stage(const std::string& what);
  /// A claim of the paper and whether the numbers bear it out, as a line `VERDICT holds: ...` or `VERDICT FAILS: ...`.
  void claim(bool holds, const std::string& what);
  /// Ends the last stage.
  void finish();
  bool all_hold() const { return all_hold_; }

 private:
  Stopwatch watch_;
  bool in_stage_ = false, all_hold_ = true;
};

/// Parses the command line, runs `body`, and turns the outcome into an exit status: 0 all claims hold, 1 one fails, 2
/// bad input (one line on standard error), 3 a solver did not converge (one line that says how far it came).
int run(int argc, char** argv, const std::string& stem, const std::string& what, Options options,
        const std::function<void(const Options&, Report&)>& body);

}  // namespace antilock::tutorial
