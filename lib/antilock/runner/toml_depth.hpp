#pragma once
#include <string>
#include <string_view>

namespace antilock {

/// Throws InputError, `NAME: syntax: line N: what is wrong; accepted: ...`, where a key of the TOML
/// text has more than 64 parts between dots, or more than 64 brackets are open at once. The parser
/// calls itself for each part, so that a key of 200,000 parts would overflow the stack. Brackets
/// and dots in strings and comments do not count. The text need not be valid.
void check_toml_depth(std::string_view text, const std::string& name);

}  // namespace antilock
