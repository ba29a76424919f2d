#pragma once
#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "antilock/core/stopwatch.hpp"
#include "antilock/study/table.hpp"

namespace CLI {
class App;
}

namespace antilock::tutorial {

struct Options;
class Report;

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

/// What a tutorial says while it runs: stages with their seconds, and the verdict at its end.
class Report {
 public:
  /// Prints what is being done now; the seconds of the stage before are printed when the next begins. Throws Error
  /// where what is printed does not arrive.
  void stage(const std::string& what);
  /// A claim of the paper and whether the numbers bear it out: a line `VERDICT holds: ...` or `VERDICT FAILS: ...`.
  void claim(bool holds, const std::string& what);
  /// The same with a format string, `claim(order > 1.8, "falls like h^{:.2f}", order)`.
  template <class First, class... More>
  void claim(bool holds, fmt::format_string<First, More...> what, First&& first, More&&... more) {
    claim(holds, fmt::format(what, std::forward<First>(first), std::forward<More>(more)...));
  }
  /// A claim that a number lies in an interval; its line ends with the number and the interval.
  void claim_within(double value, double low, double high, const std::string& what);
  /// The same of the orders of `y` in h between each row and the next; they are observed.
  void claim_orders(const Table& rows, const std::string& y, double low, double high, const std::string& what);
  /// The same of the order of y in x, a least-squares slope; its line ends with the order, those from row to row, and
  /// the interval. Not judged from fewer than four rows.
  void claim_order(const Table& rows, const std::string& y, const std::string& x, double low, double high,
                   const std::string& what);
  /// A claim that this run cannot decide, and why: a line `NOT JUDGED: ...`. Nothing is left out in silence.
  void not_judged(const std::string& why);
  /// Ends the last stage.
  void finish();
  bool all_hold() const { return all_hold_; }

 private:
  Stopwatch watch_;
  bool in_stage_ = false, all_hold_ = true;
};

/// Fills the values of the options; those given beforehand are the defaults that --help shows. Returns nothing where the
/// program goes on, otherwise the status to exit with: 0 after --help, 2 after an option that is not accepted (NaN is not),
/// which one line on standard error names, or where the help did not arrive. `silent`: nothing is printed, for every rank of a parallel run but the first.
std::optional<int> parse(CLI::App& line, int argc, char** argv, bool silent = false);

/// One thread of the BLAS, unless OPENBLAS_NUM_THREADS says otherwise: two were no faster, since they wait for each
/// other by spinning, and much slower beside other programs. The kernels of this CPU: OpenBLAS knows CPUs by model
/// number, and gives kernels of 2004 to one that is younger than itself; the factor then takes 1.6 times as long. And
/// memory in large pages. Both are read where a program starts, so it starts again with what the environment does not
/// name yet. Returns where there is nothing to gain, and where ANTILOCK_KEEP_KERNELS asks to leave all as it is.
/// `parse` calls it; a program that starts MPI does so before.
void choose_machine(char** argv);

/// Becomes the program of that name beside this one (this one again, where it is empty), with the same arguments.
/// Returns where there is none.
void become(const std::string& program, char** argv);

/// The path of a program that stands in the folder of this one; its bare name where there is none.
std::string beside(const std::string& program);

/// A word of a command as a shell takes it: in quotes where a blank, a bracket or another sign would mean something.
std::string in_shell(const std::string& word);

/// Parses the command line, runs `body` or the exercise asked for, and turns the outcome into an exit status: 0 all
/// claims hold, 1 one fails, 2 bad input (one line on standard error), 3 a solver did not converge (one line that says
/// how far it came).
int run(int argc, char** argv, const std::string& stem, const std::string& what, Options options,
        const std::function<void(const Options&, Report&)>& body);

}  // namespace antilock::tutorial
