#pragma once
#include <stdexcept>
#include <string>
#include <string_view>

namespace antilock {

/// The base class of all errors that a user can cause. The message is one line: what is wrong,
/// where, and what is accepted.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An Error whose message names the input file and the key at fault, `FILE: KEY: ...`. Callers
/// rethrow it without a prefix.
struct InputError : Error {
  using Error::Error;
};

/// Thrown by a solver that has not converged, in place of a solution. `what()` says how far it
/// came.
struct NotConverged : Error {
  NotConverged(const std::string& message, double reached, int steps)
      : Error(message), reached(reached), steps(steps) {}
  double reached;  ///< the relative error measure at which the solver stopped (dimensionless)
  int steps;       ///< the iterations done
};

/// Returns text from a file or a command line for use in a message of one line. Characters of UTF-8
/// stay as they are. Control characters, characters that change the direction of the text or begin
/// a new line, and bytes that are not UTF-8 become '?'. Text of more than `longest` characters is
/// cut and ends in "...".
std::string printable(std::string_view text, std::size_t longest = 60);

/// Returns the first character of a text in UTF-8, of one to four bytes. If the first byte does not
/// begin a character, it returns this byte. The result is empty for an empty text.
std::string_view first_character(std::string_view text);

}  // namespace antilock
