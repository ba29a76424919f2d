#include "antilock/core/detail/progress.hpp"

#include <fmt/format.h>

namespace antilock {

void report(const ProgressHook& hook, const Progress& progress, const std::string& who) {
  if (!hook || hook(progress)) return;
  throw Stopped(fmt::format("{}: stopped as asked after {} steps of {}: relative error about {:.0e}, asked for {:.0e}",
                            who, progress.step, progress.stage, progress.reached, progress.asked),
                progress.reached, progress.step);
}

}  // namespace antilock
