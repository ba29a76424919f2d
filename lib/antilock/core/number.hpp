#pragma once
#include <charconv>
#include <string_view>
#include <system_error>

namespace antilock {

/// Reads `text`, all of it, as a number with a point for the decimals, whatever the locale is. A
/// plus sign is accepted, since printf's "%+g" and Fortran's SP write it. Returns false and leaves
/// `value` unchanged if `text` is not a number. "inf" and "nan" are numbers of type double.
template <class Number>
bool read_number(std::string_view text, Number& value) {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return false;  // which std::from_chars would take
  }
  Number read{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), read);
  if (error != std::errc{} || end != text.data() + text.size()) return false;
  value = read;
  return true;
}

}  // namespace antilock
