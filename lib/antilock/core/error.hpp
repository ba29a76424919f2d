#pragma once
#include <stdexcept>
#include <string>
#include <string_view>

namespace antilock {

/// What every failure that a user can cause is reported by: one line that says what, where and what is accepted.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An Error whose message names the input file and the key at fault, `FILE: KEY: ...`. It is handed on as it is:
/// nobody puts a name before it.
struct InputError : Error {
  using Error::Error;
};

/// A solver that ended without an answer; `what()` says how far it came. It never comes with a solution.
struct NotConverged : Error {
  NotConverged(const std::string& message, double reached, int steps)
      : Error(message), reached(reached), steps(steps) {}
  double reached;  ///< the relative error measure at which the solver stopped (dimensionless)
  int steps;       ///< the iterations done
};

/// Text from a file or a command line for use in a message of one line. Characters of UTF-8 stay as
/// they are; a control character, one that changes the direction or the line of the text, and each
/// byte that is no UTF-8 become '?'. Text of more than `longest` characters is cut and ends in "...".
std::string printable(std::string_view text, std::size_t longest = 60);

/// The first character of a text in UTF-8, of one to four bytes: its first byte where that begins no
/// character. Empty for an empty text.
std::string_view first_character(std::string_view text);

}  // namespace antilock
