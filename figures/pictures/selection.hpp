#pragma once
#include <string>
#include <vector>

#include "pictures/table.hpp"

namespace antilock::figures {

/// Whether a row passes every filter `column=value`. Throws Error for a filter of another form.
bool selected(const Table& table, std::size_t row, const std::vector<std::string>& filters);

/// What titles and legends call the row's entries of these columns: `$P_1$, structured mesh`.
std::string key_markup(const Table& table, std::size_t row, const std::vector<std::string>& columns);

}  // namespace antilock::figures
