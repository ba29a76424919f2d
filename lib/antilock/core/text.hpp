#pragma once
#include <fmt/compile.h>
#include <fmt/format.h>

#include <ostream>

namespace antilock {

/// Formatted text on its way to a stream, in blocks: a stream asked number by number takes ten times as long.
/// Formats of lines that come by the million are compiled, FMT_COMPILE("{}\n"): the others are read anew each time.
/// `{}` of a double is the shortest text that reads back as the same double (17 digits at most).
class Text {
 public:
  explicit Text(std::ostream& out) : out_(out) {}
  ~Text() { flush(); }
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;

  template <class... Values>
  void print(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(fmt::appender(buffer_), format, std::forward<Values>(values)...);
    if (buffer_.size() > block) flush();
  }
  template <class Compiled, class... Values>
  requires fmt::detail::is_compiled_string<Compiled>::value void print(const Compiled& format,
                                                                       const Values&... values) {
    fmt::format_to(fmt::appender(buffer_), format, values...);
    if (buffer_.size() > block) flush();
  }

 private:
  static constexpr std::size_t block = 1 << 16;
  void flush() {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }
  std::ostream& out_;
  fmt::memory_buffer buffer_;
};

}  // namespace antilock
