#pragma once
#include <algorithm>
#include <functional>
#include <vector>

#include "antilock/core/stopwatch.hpp"

namespace antilock::tutorial {

/// Runs `work` `repeats` times, at least once, and returns the median of its wall seconds.
inline double median_seconds(int repeats, const std::function<void()>& work) {
  std::vector<double> seconds;
  for (int k = 0; k < std::max(1, repeats); ++k) {
    const Stopwatch watch;
    work();
    seconds.push_back(watch.seconds());
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds[seconds.size() / 2];
}

}  // namespace antilock::tutorial
