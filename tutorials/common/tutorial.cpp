#include "common/tutorial.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>

#include "antilock/core/detail/atomic_file.hpp"
#include "antilock/core/error.hpp"

namespace antilock::tutorial {
namespace {

int fail(const std::string& stem, const std::string& message, int status) {
  std::fflush(stdout);
  fmt::print(stderr, "{}: {}\n", stem, message);
  return status;
}

/// Better now than after minutes of work.
void check_writable(const std::filesystem::path& folder) {
  const auto probe = folder / ".writable";
  write_file(probe, [](std::ostream&) {});
  std::filesystem::remove(probe);
}

/// What --help says about the exercises.
std::string list(const std::vector<Exercise>& exercises) {
  std::string text = exercises.empty() ? "" : "Exercises:\n";
  for (std::size_t i = 0; i < exercises.size(); ++i) text += fmt::format("  {}. {}\n", i + 1, exercises[i].question);
  return text;
}

}  // namespace

void Report::stage(const std::string& what) {
  finish();
  fmt::print("  {:<60}", what + " ...");
  std::fflush(stdout);
  watch_.lap();
  in_stage_ = true;
}

void Report::finish() {
  if (in_stage_) fmt::print(" {:8.3f} s\n", watch_.lap());
  in_stage_ = false;
  std::fflush(stdout);
}

void Report::claim(bool holds, const std::string& what) {
  finish();
  fmt::print("VERDICT {}: {}\n", holds ? "holds" : "FAILS", what);
  all_hold_ = all_hold_ && holds;
}

void Report::claim_orders(const Table& rows, const std::string& y, double low, double high, const std::string& what) {
  const std::vector<double> orders = rows.pairwise_orders(y, "h");
  const bool hold =
      std::all_of(orders.begin(), orders.end(), [&](double order) { return order >= low && order <= high; });
  claim(hold && !orders.empty(), "{}: orders in h {:.2f} (accepted {:g} to {:g}; observed)", what,
        fmt::join(orders, ", "), low, high);
}

void Report::not_judged(const std::string& why) {
  finish();
  fmt::print("NOT JUDGED: {}\n", why);
}

void Report::claim_within(double value, double low, double high, const std::string& what) {
  claim(value >= low && value <= high, "{} {:.4g} (accepted {:.4g} to {:.4g})", what, value, low, high);
}

void Report::claim_order(const Table& rows, const std::string& y, const std::string& x, double low, double high,
                         const std::string& what) {
  if (rows.size() < 4) return not_judged(fmt::format("{}: an order needs four rows, here are {}", what, rows.size()));
  const double order = rows.order(y, x);
  claim(order >= low && order <= high, "{}: order {:.2f} ({:.2f} from row to row; accepted {:.2f} to {:.2f})", what,
        order, fmt::join(rows.pairwise_orders(y, x), ", "), low, high);
}

int run(int argc, char** argv, const std::string& stem, const std::string& what, Options options,
        const std::function<void(const Options&, Report&)>& body) {
  CommandLine line(what, stem);
  if (options.out.empty()) options.out = std::filesystem::path("results") / stem;
  if (options.takes_epsilon) line.add("--epsilon", options.epsilon, options.epsilon_is, options.least_epsilon, 1);
  line.add("--cells", options.cells, "cells per unit side, h = 1/cells", options.least_cells, options.most_cells);
  line.add("--out", options.out, "folder of the results");
  int exercise = 0;
  if (const int count = static_cast<int>(options.exercises.size()); count > 0) {
    line.add("--exercise", exercise, "a variation, predicted and checked", 1, count);
    line.footer(list(options.exercises));
  }
  options.add(line);
  if (const auto status = line.parse(argc, argv)) return *status;
  if (exercise > 0 && !line.given("--out")) options.out.clear();  // an exercise leaves nothing behind unless asked
  try {
    if (!options.out.empty()) check_writable(options.out);
    fmt::print("{}: {}\n", stem, exercise > 0 ? fmt::format("exercise {}", exercise) : what);
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
    return report.all_hold() ? 0 : 1;
  } catch (const NotConverged& failure) {
    return fail(stem, failure.what(), 3);
  } catch (const std::exception& error) {
    return fail(stem, error.what(), 2);
  }
}

}  // namespace antilock::tutorial
