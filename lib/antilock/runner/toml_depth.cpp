#include "antilock/runner/toml_depth.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

/// The length of the string at the beginning of `text`, with its quotation marks. One that is not
/// closed ends with its line or, between three quotation marks, with the text.
std::size_t string_length(std::string_view text) {
  const char quote = text[0];
  const std::string three(3, quote);
  const bool many_lines = text.starts_with(three);
  const std::string_view closing = std::string_view(three).substr(0, many_lines ? 3 : 1);
  std::size_t at = closing.size();
  while (at < text.size() && !text.substr(at).starts_with(closing)) {
    if (text[at] == '\n' && !many_lines) return at;
    at += quote == '"' && text[at] == '\\' ? 2 : 1;  // a backslash hides a quotation mark
  }
  at += closing.size();
  for (int more = 0; many_lines && more < 2 && at < text.size() && text[at] == quote; ++more) ++at;
  return std::min(at, text.size());
}

}  // namespace

void check_toml_depth(std::string_view text, const std::string& name) {
  constexpr int most = 64;
  int open = 0, dots = 0;
  const auto check = [&](int depth, std::size_t at, std::string_view what,
                         std::string_view accepted) {
    if (depth > most)
      throw InputError(fmt::format(
          "{}: syntax: line {}: {}; accepted: up to {} {}", name,
          1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'), what,
          most, accepted));
  };
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at += string_length(text.substr(at));
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (c == '[' || c == '{') ++open;
    if (c == ']' || c == '}') --open;
    if (c == '.') ++dots;
    if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) dots = 0;
    check(open, at, "is nested too deeply", "brackets in each other");
    check(dots + 1, at, "a key has too many parts", "parts between dots");
    ++at;
  }
}

}  // namespace antilock
