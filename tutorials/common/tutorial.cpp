#include "common/tutorial.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "antilock/core/atomic_file.hpp"
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

int run(int argc, char** argv, const std::string& stem, const std::string& what, Options options,
        const std::function<void(const Options&, Report&)>& body) {
  CommandLine line(what, stem);
  if (options.out.empty()) options.out = std::filesystem::path("results") / stem;
  if (options.takes_epsilon)
    line.add("--epsilon", options.epsilon, "the paper's epsilon; 0 is the rigid limit", options.least_epsilon, 1);
  line.add("--cells", options.cells, "cells per unit side, h = 1/cells", options.least_cells, options.most_cells);
  line.add("--out", options.out, "folder of the results");
  options.add(line);
  if (const auto status = line.parse(argc, argv)) return *status;
  try {
    check_writable(options.out);
    fmt::print("{}: {}\n", stem, what);
    const Stopwatch watch;
    Report report;
    body(options, report);
    report.finish();
    fmt::print("{} in {:.2f} s; results in {}\n", stem, watch.seconds(), options.out.string());
    return report.all_hold() ? 0 : 1;
  } catch (const NotConverged& failure) {
    return fail(stem, failure.what(), 3);
  } catch (const Error& error) {
    return fail(stem, error.what(), 2);
  } catch (const std::exception& error) {
    return fail(stem, error.what(), 2);
  }
}

}  // namespace antilock::tutorial
