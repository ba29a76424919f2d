#pragma once
#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "antilock/core/error.hpp"

namespace antilock {

using Names = std::initializer_list<std::string>;

/// A section of the file: gives its values, each checked, and refuses with the name of the file and of the key.
class Section {
 public:
  Section(std::string file, std::string name, const toml::table& table)
      : file_(std::move(file)), name_(std::move(name)), table_(table) {}

  [[noreturn]] void refuse(const std::string& key, const std::string& why) const { throw Error(where(key) + why); }
  std::string where(const std::string& key) const {
    std::string full = name_;
    if (!full.empty() && !key.empty()) full += '.';
    return printable(file_, 1000) + ": " + full + printable(key) + ": ";
  }

  void only(Names accepted) const {
    for (const auto& [key, value] : table_)
      if (const std::string name(key.str()); std::find(accepted.begin(), accepted.end(), name) == accepted.end())
        refuse(name, fmt::format("unknown {}; accepted: {}", name_.empty() ? "key or section" : "key",
                                 fmt::join(accepted, ", ")));
  }
  bool has(const std::string& key) const { return table_.contains(key); }
  const toml::table& table() const { return table_; }

  /// Here and in one_of: `otherwise`, where it is given and the key is absent.
  std::string text(const std::string& key, const std::string& accepted, const char* otherwise = nullptr) const {
    if (otherwise != nullptr && !has(key)) return otherwise;
    const auto value = table_[key].value_exact<std::string>();
    if (!value) refuse(key, what_stands_there(key) + "; accepted: " + accepted);
    return *value;
  }
  std::string one_of(const std::string& key, Names accepted, const char* otherwise = nullptr) const {
    const std::string list = fmt::format("\"{}\"", fmt::join(accepted, "\", \""));
    std::string value = text(key, list, otherwise);
    if (std::find(accepted.begin(), accepted.end(), value) == accepted.end())
      refuse(key, fmt::format("\"{}\" is unknown; accepted: {}", printable(value), list));
    return value;
  }
  double number(const std::string& key, const std::string& accepted) const {
    std::optional<double> value = table_[key].value_exact<double>();
    if (const auto integer = table_[key].value_exact<std::int64_t>()) value = static_cast<double>(*integer);
    if (!value) refuse(key, what_stands_there(key) + "; accepted: a number, " + accepted);
    if (!std::isfinite(*value)) refuse(key, "is not finite; accepted: a number, " + accepted);
    return *value + 0.0;  // -0.0 becomes 0.0
  }
  /// The same, of a number for which `holds` is true.
  template <class Holds>
  double number(const std::string& key, const std::string& accepted, const Holds& holds) const {
    const double value = number(key, accepted);
    if (!holds(value)) refuse(key, fmt::format("{} is out of range; accepted: {}", value, accepted));
    return value;
  }
  int count(const std::string& key, int most) const {
    const std::string accepted = fmt::format("; accepted: a whole number, 1 to {}", most);
    const auto value = table_[key].value_exact<std::int64_t>();
    if (!value) refuse(key, what_stands_there(key) + accepted);
    if (*value < 1 || *value > most) refuse(key, fmt::format("{} is out of range{}", *value, accepted));
    return static_cast<int>(*value);
  }

  /// [key]; empty where it is absent.
  Section section(const std::string& key) const {
    static const toml::table absent;
    if (!has(key)) return {file_, key, absent};
    const toml::table* table = table_[key].as_table();
    if (table == nullptr) refuse(key, fmt::format("{}; accepted: a section [{}]", what_stands_there(key), key));
    return {file_, key, *table};
  }
  /// [[key]]: its tables, named key[0], key[1], ...
  std::vector<Section> sections(const std::string& key) const {
    std::vector<Section> all;
    if (!has(key)) return all;
    const toml::array* array = table_[key].as_array();
    if (array == nullptr || !array->is_array_of_tables())
      refuse(key, fmt::format("{}; accepted: sections [[{}]]", what_stands_there(key), key));
    for (const toml::node& node : *array)
      all.emplace_back(file_, fmt::format("{}[{}]", key, all.size()), *node.as_table());
    return all;
  }

 private:
  std::string what_stands_there(const std::string& key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return "is missing";
    std::ostringstream type;
    type << node->type();
    return "is of type " + type.str();
  }

  std::string file_, name_;
  const toml::table& table_;
};

}  // namespace antilock
