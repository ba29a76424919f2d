#pragma once
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "antilock/core/error.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// Adds a row of entries with the names of their columns, in any order. Throws Error unless
/// the row names each column of the table once.
inline void add_row(Table& table,
                    const std::vector<std::pair<std::string, TableEntry>>& row) {
  std::vector<TableEntry> entries;
  for (const std::string& column : table.columns()) {
    const auto named = [&](const auto& entry) { return entry.first == column; };
    const auto found = std::find_if(row.begin(), row.end(), named);
    if (found == row.end()) throw Error("a row without an entry for the column " + column);
    entries.push_back(found->second);
  }
  if (row.size() != entries.size())
    throw Error("a row names a column that the table does not have, or names one twice");
  table.add(entries);
}

}  // namespace antilock::tutorial
