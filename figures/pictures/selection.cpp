#include "pictures/selection.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "antilock/scene/error.hpp"
#include "drawing/axis.hpp"

namespace antilock::figures {

bool selected(const Table& table, std::size_t row, const std::vector<std::string>& filters) {
  return std::all_of(filters.begin(), filters.end(), [&](const std::string& filter) {
    const auto equals = filter.find('=');
    if (equals == std::string::npos) throw Error(fmt::format("filter '{}': accepted: column=value", filter));
    return table.text(row, filter.substr(0, equals)) == filter.substr(equals + 1);
  });
}

std::string key_markup(const Table& table, std::size_t row, const std::vector<std::string>& columns) {
  std::string name;
  for (const std::string& column : columns)
    name += (name.empty() ? "" : ", ") + entry_markup(column, table.text(row, column));
  return name;
}

}  // namespace antilock::figures
