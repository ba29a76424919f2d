#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "antilock/core/error.hpp"

namespace antilock {

/// A MSH file as lines of fields, one record a line as gmsh writes them; blank lines are skipped. It knows where it is,
/// so that every refusal names the file and the line. Throws Error alone.
class MshLines {
 public:
  /// Takes the whole stream. Throws Error where it cannot be read or is empty.
  MshLines(std::istream& in, std::string name);

  /// Moves to the next line that is not blank; false at the end of the file.
  bool next();
  /// Moves to the next record of `section`; refuses the end of the file, a line that starts with $ (fewer records than
  /// declared), and, unless it is 0, another number of fields; `what` says what the fields are.
  void next_record(std::string_view section, std::size_t fields = 0, std::string_view what = "");
  /// Refuses anything but the end of `section`: more records than declared, or a truncated file.
  void end_section(std::string_view section);
  /// Passes over a section that the mesh does not need.
  void skip_section(std::string_view section);

  const std::string& name() const { return name_; }
  int line_number() const { return line_number_; }
  std::string_view line() const { return line_; }
  std::size_t fields() const { return fields_.size(); }
  std::string_view field(std::size_t i) const { return fields_[i]; }
  std::int64_t integer(std::size_t field) const;  ///< refuses what is no 64-bit integer
  std::int64_t count(std::size_t field) const;    ///< refuses what is no integer >= 0
  double coordinate(std::size_t field) const;     ///< refuses what is no finite number

  /// Throws Error about this line, another one or the file, `why` a format of the values.
  template <class... Values>
  [[noreturn]] void refuse(fmt::format_string<const Values&...> why, const Values&... values) const {
    refuse_at(line_number_, why, values...);
  }
  template <class... Values>
  [[noreturn]] void refuse_at(int line, fmt::format_string<const Values&...> why, const Values&... values) const {
    throw Error(fmt::format("{}: line {}: {}", name_, line, fmt::format(why, values...)));
  }
  template <class... Values>
  [[noreturn]] void refuse_file(fmt::format_string<const Values&...> why, const Values&... values) const {
    throw Error(fmt::format("{}: {}", name_, fmt::format(why, values...)));
  }

 private:
  std::string name_, text_;
  std::size_t position_ = 0;
  int line_number_ = 0;
  std::string_view line_;
  std::vector<std::string_view> fields_;
};

/// Text from a file for use in a one-line message: in quotes, printable, shortened.
std::string in_quotes(std::string_view text);

}  // namespace antilock
