#pragma once
#include <fmt/format.h>

#include <functional>
#include <string>

#include "antilock/core/error.hpp"

namespace antilock {

/// Where a long computation stands. Solvers report once per iteration.
struct Progress {
  std::string stage;     ///< such as "corrections" or "contact"
  int step = 0;          ///< iterations done in this stage, from 1
  double error = 1;      ///< the estimated relative error now (dimensionless); 1 where it is not known yet
  double tolerance = 0;  ///< the tolerance, to which `error` falls
};

/// Called with the progress of a computation; `false` stops it. An empty hook costs nothing.
using ProgressHook = std::function<bool(const Progress&)>;

/// A computation that its progress hook stopped. It never comes with a solution.
struct Interrupted : NotConverged {
  using NotConverged::NotConverged;
};

/// Calls the hook, if there is one. Throws Interrupted, with how far `who` came, where the hook says so.
inline void notify_or_throw(const ProgressHook& hook, const Progress& progress, const std::string& who) {
  if (!hook || hook(progress)) return;
  throw Interrupted(
      fmt::format("{}: stopped as asked after {} steps of {}: relative error about {:.0e}, asked for {:.0e}", who,
                  progress.step, progress.stage, progress.error, progress.tolerance),
      progress.error, progress.step);
}

}  // namespace antilock
