#pragma once
#include <string>
#include <string_view>

#include "antilock/core/error.hpp"

namespace antilock {

/// Returns the text of a file without the byte order mark of UTF-8, which spreadsheets and editors
/// of Windows put before it. Throws Error, whose message begins with `name`, for a text in UTF-16
/// or UTF-32. Such a text begins with a mark of its own, or one of its first two bytes is zero,
/// since the first character of a text file is in ASCII.
inline std::string_view plain_text(std::string_view text, const std::string& name) {
  if (text.starts_with("\xef\xbb\xbf")) return text.substr(3);
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff") ||
      text.substr(0, 2).find('\0') != text.npos)
    throw Error(name +
                ": is text in UTF-16 or UTF-32; accepted: UTF-8 or ASCII (save it again with that "
                "encoding)");
  return text;
}

}  // namespace antilock
