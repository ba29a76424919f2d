#include "pictures/selection.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "antilock/core/error.hpp"

namespace antilock::figures {

bool selected(const CsvTable& table, std::size_t row, const std::vector<std::string>& filters) {
  return std::all_of(filters.begin(), filters.end(), [&](const std::string& filter) {
    const auto equals = filter.find('=');
    if (equals == std::string::npos)
      throw Error(fmt::format("filter '{}': accepted: column=value", filter));
    return table.text(row, filter.substr(0, equals)) == filter.substr(equals + 1);
  });
}

Meaning row_meaning(const CsvTable& table, std::size_t row,
                    const std::vector<std::string>& columns) {
  std::vector<std::string> entries;
  entries.reserve(columns.size());
  for (const std::string& column : columns) entries.push_back(table.text(row, column));
  return meaning_of(columns, entries);
}

void Meanings::add(Meaning meaning) {
  const auto named = [&](const Meaning& other) { return other.name == meaning.name; };
  if (std::any_of(meanings_.begin(), meanings_.end(), named)) return;
  if (!meaning.known) meaning.look = other_look(others_++);
  const auto place =
      std::upper_bound(meanings_.begin(), meanings_.end(), meaning,
                       [](const Meaning& a, const Meaning& b) { return a.rank < b.rank; });
  meanings_.insert(place, std::move(meaning));
}

std::vector<std::string> Meanings::names(
    const std::function<bool(const std::vector<std::string>&)>& fit) const {
  std::vector<std::string> names, short_names;
  for (const Meaning& meaning : meanings_) {
    names.push_back(meaning.name);
    short_names.push_back(meaning.short_name);
  }
  return fit(names) ? names : short_names;
}

}  // namespace antilock::figures
