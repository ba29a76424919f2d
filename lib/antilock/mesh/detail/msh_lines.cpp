#include "antilock/mesh/detail/msh_lines.hpp"

#include <charconv>
#include <cmath>
#include <istream>
#include <iterator>
#include <sstream>

namespace antilock {
namespace {

template <class Number>
bool parse(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

constexpr std::string_view blanks = " \t\r\v\f";

}  // namespace

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown(text.substr(0, longest));
  for (char& c : shown)
    if (c < ' ' || c > '~') c = '?';
  return '"' + shown + (text.size() > longest ? "...\"" : "\"");
}

MshLines::MshLines(std::istream& in, std::string name) : name_(std::move(name)) {
  std::ostringstream all;
  if (in) all << in.rdbuf();
  if (in.bad()) refuse_file("cannot be read");
  text_ = std::move(all).str();
  if (text_.empty()) refuse_file("is empty or cannot be read; accepted: MSH 2.2 or 4.1, ASCII");
}

bool MshLines::next() {
  while (position_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', position_), text_.size());
    line_ = std::string_view(text_).substr(position_, end - position_);
    position_ = end + 1;
    ++line_number_;
    fields_.clear();
    for (std::size_t from = line_.find_first_not_of(blanks); from != line_.npos;) {
      const std::size_t to = std::min(line_.find_first_of(blanks, from), line_.size());
      fields_.push_back(line_.substr(from, to - from));
      from = line_.find_first_not_of(blanks, to);
    }
    if (!fields_.empty()) return true;
  }
  return false;
}

void MshLines::next_record(std::string_view section, std::size_t fields, std::string_view what) {
  if (!next()) refuse_file("truncated: it ends within ${}", section);
  if (fields_[0].front() == '$') refuse("{} where ${} declares further entries", in_quotes(fields_[0]), section);
  if (fields > 0 && fields_.size() != fields)
    refuse("{} fields in ${}; accepted: {} ({})", fields_.size(), section, fields, what);
}

void MshLines::end_section(std::string_view section) {
  if (!next()) refuse_file("truncated: it ends within ${}", section);
  if (fields_.size() != 1 || fields_[0] != fmt::format("$End{}", section))
    refuse("{} where the entries that ${} declares are over; accepted: $End{}", in_quotes(line_), section, section);
}

void MshLines::skip_section(std::string_view section) {
  const std::string end = fmt::format("$End{}", section);
  while (next())
    if (fields_[0] == end) return;
  refuse_file("truncated: no {} follows", in_quotes(end));
}

std::int64_t MshLines::integer(std::size_t field) const {
  std::int64_t number = 0;
  if (!parse(fields_[field], number)) refuse("{} is no integer", in_quotes(fields_[field]));
  return number;
}

std::int64_t MshLines::count(std::size_t field) const {
  const std::int64_t number = integer(field);
  if (number < 0) refuse("{} is no count; accepted: 0 or more", number);
  return number;
}

double MshLines::coordinate(std::size_t field) const {
  double number = 0;
  if (!parse(fields_[field], number) || !std::isfinite(number))
    refuse("{} is no coordinate; accepted: a finite number", in_quotes(fields_[field]));
  return number;
}

}  // namespace antilock
