#include "course/chapter.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/standard_output.hpp"
#include "antilock/core/stopwatch.hpp"
#include "programs/program.hpp"
#include "programs/report.hpp"

namespace antilock::tutorial {

int run(int argc, char** argv, const std::string& stem, const std::string& what,
        Options options, const std::function<void(const Options&, Report&)>& body) {
  CLI::App line(what, stem);
  if (options.out.empty()) options.out = std::filesystem::path("results") / stem;
  if (options.takes_epsilon)
    line.add_option("--epsilon", options.epsilon, options.epsilon_is)
        ->check(CLI::Range(options.least_epsilon, 1.0));
  line.add_option("--cells", options.cells, "cells per unit side, h = 1/cells")
      ->check(CLI::Range(options.least_cells, options.most_cells));
  const CLI::Option* out = line.add_option("--out", options.out, "folder of the results");
  int exercise = 0;
  if (const int count = static_cast<int>(options.exercises.size()); count > 0) {
    line.add_option("--exercise", exercise, "a variation, predicted and checked")
        ->check(CLI::Range(1, count));
    std::string questions = "Exercises:\n";
    for (int i = 0; i < count; ++i)
      questions += fmt::format("  {}. {}\n", i + 1, options.exercises[i].question);
    line.footer(questions);
  }
  options.add(line);
  if (const auto status = parse(line, argc, argv)) return *status;
  if (exercise > 0 && out->count() == 0)
    options.out.clear();  // an exercise leaves nothing behind unless asked
  try {
    if (const auto probe = options.out / ".writable";
        !options.out.empty()) {  // better now than after minutes of work
      write_file(probe, [](std::ostream&) {});
      std::filesystem::remove(probe);
    }
    fmt::print("{}: {}\n", stem,
               exercise > 0 ? fmt::format("exercise {}", exercise) : what);
    require_output();  // not every body begins with a stage
    const Stopwatch watch;
    Report report;
    if (exercise > 0) {
      const auto& [question, prediction, outcome] = options.exercises[exercise - 1];
      fmt::print("QUESTION: {}\nPREDICTION: {}\n", question, prediction);
      outcome(options, report);
    } else {
      body(options, report);
    }
    report.finish();
    fmt::print("{} in {:.2f} s{}\n", stem, watch.seconds(),
               options.out.empty() ? "" : "; results in " + options.out.string());
    return delivered(report.all_hold() ? 0 : 1, stem);
  } catch (const std::exception& error) {
    std::fflush(stdout);
    std::fputs(fmt::format("{}: {}\n", stem, error.what()).c_str(),
               stderr);  // it cannot throw
    return dynamic_cast<const NotConverged*>(&error) != nullptr ? 3 : 2;
  }
}

}  // namespace antilock::tutorial
