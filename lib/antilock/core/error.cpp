#include "antilock/core/error.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace antilock {
namespace {

/// The code point that `text` begins with, and its number of bytes: 0 where it begins with none.
struct CodePoint {
  char32_t value = 0;
  std::size_t bytes = 0;
};

CodePoint first_code_point(std::string_view text) {
  if (text.empty()) return {};
  const auto first = static_cast<unsigned char>(text[0]);
  if (first < 0x80) return {first, 1};
  // 110xxxxx, 1110xxxx and 11110xxx begin a character of 2, 3 and 4 bytes; 10xxxxxx continues one
  std::size_t bytes = 2;
  if (first >= 0xe0) bytes = 3;
  if (first >= 0xf0) bytes = 4;
  if (first < 0xc0 || first >= 0xf8 || text.size() < bytes) return {};
  auto value = static_cast<char32_t>(first & (0x7f >> bytes));
  for (std::size_t i = 1; i < bytes; ++i) {
    const auto next = static_cast<unsigned char>(text[i]);
    if ((next & 0xc0) != 0x80) return {};
    value = value << 6 | (next & 0x3f);
  }
  // a value that fewer bytes can hold, a half of a pair of UTF-16, and what is beyond Unicode
  constexpr std::array<char32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
  if (value < least[bytes] || (value >= 0xd800 && value <= 0xdfff) || value > 0x10ffff) return {};
  return {value, bytes};
}

/// Whether a terminal shows the character in its place on the line.
bool stays_on_the_line(char32_t value) {
  const auto in = [value](char32_t first, char32_t last) {
    return first <= value && value <= last;
  };
  const bool control = value < 0x20 || in(0x7f, 0x9f);
  const bool separator = in(0x2028, 0x2029);
  const bool direction =
      in(0x200e, 0x200f) || in(0x202a, 0x202e) || in(0x2066, 0x2069) || value == 0x061c;
  const bool no_character = value == 0xfeff || in(0xfff9, 0xfffb) || (value & 0xfffe) == 0xfffe;
  return !control && !separator && !direction && !no_character;
}

}  // namespace

std::string printable(std::string_view text, std::size_t longest) {
  std::string line;
  for (std::size_t characters = 0; !text.empty(); ++characters) {
    if (characters == longest) return line + "...";
    const CodePoint point = first_code_point(text);
    const std::size_t bytes = std::max<std::size_t>(point.bytes, 1);
    if (point.bytes > 0 && stays_on_the_line(point.value))
      line += text.substr(0, bytes);
    else
      line += '?';
    text.remove_prefix(bytes);
  }
  return line;
}

std::string_view first_character(std::string_view text) {
  return text.substr(0, std::max<std::size_t>(first_code_point(text).bytes, 1));
}

}  // namespace antilock
