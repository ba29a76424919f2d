#pragma once
#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

namespace antilock {

/// What every failure that a user can cause is reported by: one line that says what, where and what is accepted.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A solver that ended without an answer; `what()` says how far it came. It never comes with a solution.
struct NotConverged : Error {
  NotConverged(const std::string& message, double reached, int steps)
      : Error(message), reached(reached), steps(steps) {}
  double reached;  ///< the relative error measure at which the solver stopped (dimensionless)
  int steps;       ///< the iterations done
};

/// Text from a file for use in a message of one line: characters that are not printable ASCII become '?', long text is
/// cut.
inline std::string printable(std::string_view text, std::size_t longest = 60) {
  std::string line(text.substr(0, longest));
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text.size() > longest ? line + "..." : line;
}

}  // namespace antilock
