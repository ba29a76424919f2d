#pragma once
#include <fmt/compile.h>
#include <fmt/format.h>

#include <ostream>

namespace antilock {

/// Collects formatted text and writes it to a stream in blocks. Writing single numbers to a stream
/// takes ten times as long. Compile the formats of frequent lines by FMT_COMPILE("{}\n"). Other
/// formats are parsed at each call. `{}` of a double is the shortest text that reads back as the
/// same double (17 digits at most).
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
