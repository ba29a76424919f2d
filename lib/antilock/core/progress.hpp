#pragma once
#include <fmt/format.h>

#include <functional>
#include <string>

#include "antilock/core/error.hpp"

namespace antilock {

/// The progress of a long computation. Solvers report once per iteration.
struct Progress {
  std::string stage;     ///< such as "corrections" or "contact"
  int step = 0;          ///< iterations done in this stage, from 1
  double error = 1;      ///< the estimated relative error (dimensionless); 1 until it is known
  double tolerance = 0;  ///< the tolerance, to which `error` falls
};

/// Called with the progress of a computation; `false` stops it. An empty hook costs nothing.
using ProgressHook = std::function<bool(const Progress&)>;

/// Thrown by a computation that its progress hook has stopped, in place of a solution.
struct Interrupted : NotConverged {
  using NotConverged::NotConverged;
};

/// Calls the hook, if there is one. Throws Interrupted, with the progress of `who` in its message,
/// if the hook returns false.
inline void notify_or_throw(const ProgressHook& hook, const Progress& progress,
                            const std::string& who) {
  if (!hook || hook(progress)) return;
  throw Interrupted(
      fmt::format("{}: stopped as asked after {} steps of {}: relative error about {:.0e}, asked "
                  "for {:.0e}",
                  who, progress.step, progress.stage, progress.error, progress.tolerance),
      progress.error, progress.step);
}

}  // namespace antilock
