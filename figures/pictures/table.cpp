#include "pictures/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <fstream>

#include "antilock/core/error.hpp"

namespace antilock::figures {
namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back().push_back(c);
    }
  }
  return fields;
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& path) : name_(path.string()) {
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path))
    throw Error(fmt::format("{}: cannot be read; run the tutorial that writes it first", name_));
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.empty()) continue;
    auto fields = fields_of(line);
    if (header_.empty()) {
      header_ = std::move(fields);
      continue;
    }
    if (fields.size() != header_.size())
      throw Error(fmt::format("{}, line {}: {} fields where the header has {}", name_, number,
                              fields.size(), header_.size()));
    rows_.push_back(std::move(fields));
  }
  if (rows_.empty())
    throw Error(fmt::format("{}: no rows; accepted: CSV with a header line", name_));
}

std::size_t CsvTable::column_index(std::string_view column) const {
  const auto found = std::find(header_.begin(), header_.end(), column);
  if (found == header_.end())
    throw Error(
        fmt::format("{}: no column '{}'; it has {}", name_, column, fmt::join(header_, ", ")));
  return static_cast<std::size_t>(found - header_.begin());
}

const std::string& CsvTable::text(std::size_t row, std::string_view column) const {
  return rows_[row][column_index(column)];
}

double CsvTable::number(std::size_t row, std::string_view column) const {
  const std::string& field = text(row, column);
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size())
    throw Error(fmt::format("{}, row {}: '{}' in column {} is not a number", name_, row + 1, field,
                            column));
  return value;
}

std::vector<std::string> CsvTable::values(std::string_view column) const {
  std::vector<std::string> different;
  for (std::size_t row = 0; row < rows(); ++row)
    if (std::find(different.begin(), different.end(), text(row, column)) == different.end())
      different.push_back(text(row, column));
  return different;
}

}  // namespace antilock::figures
