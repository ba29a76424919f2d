#include "antilock/study/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "antilock/core/atomic_file.hpp"
#include "antilock/core/error.hpp"
#include "antilock/core/text.hpp"
#include "antilock/measure/errors.hpp"

namespace antilock {
namespace {

std::string in_csv(const std::string& word) {
  if (word.find_first_of(",\"\n\r") == std::string::npos) return word;
  std::string text = "\"";
  for (const char c : word) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

Eigen::ArrayXd some(const Table& table, const std::string& column) {
  const std::vector<double> all = table.numbers(column);
  if (all.empty())
    throw Error(fmt::format("table: column '{}' of no rows; accepted: of one or more", column));
  return Eigen::Map<const Eigen::ArrayXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

}  // namespace

std::string TableEntry::text(int digits) const {
  if (!is_number()) return std::get<std::string>(value_);
  const bool whole = number() == std::floor(number()) && std::abs(number()) < 1e9;
  return digits == 0 || whole ? fmt::format("{}", number())
                              : fmt::format("{:.{}g}", number(), digits);
}

std::size_t Table::column_index(const std::string& column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end())
    throw Error(
        fmt::format("table: no column '{}'; accepted: {}", column, fmt::join(columns_, ", ")));
  return static_cast<std::size_t>(found - columns_.begin());
}

Table::Table(std::vector<std::string> columns) : columns_(std::move(columns)) {
  for (auto name = columns_.begin(); name != columns_.end(); ++name)
    if (std::find(columns_.begin(), name, *name) != name)
      throw Error(fmt::format("table: column '{}' twice; accepted: names that differ", *name));
}

void Table::add(std::vector<TableEntry> row) {
  if (row.size() != columns_.size())
    throw Error(fmt::format("table: a row of {} entries; accepted: {}, one per column ({})",
                            row.size(), columns_.size(), fmt::join(columns_, ", ")));
  rows_.push_back(std::move(row));
}

void Table::add(const Table& other) {
  if (other.columns_ != columns_)
    throw Error(fmt::format("table: rows of the columns {}; accepted: {}",
                            fmt::join(other.columns_, ", "), fmt::join(columns_, ", ")));
  rows_.insert(rows_.end(), other.rows_.begin(), other.rows_.end());
}

Table Table::filter(const std::string& column, const TableEntry& value) const {
  return filter_rows(column, [&](const TableEntry& entry) { return entry == value; });
}

Table Table::filter_number(const std::string& column,
                           const std::function<bool(double)>& holds) const {
  numbers(column);  // refuses words
  return filter_rows(column, [&](const TableEntry& entry) { return holds(entry.number()); });
}

Table Table::filter_rows(const std::string& column,
                         const std::function<bool(const TableEntry&)>& holds) const {
  Table filter_rows(columns_);
  std::copy_if(rows_.begin(), rows_.end(), std::back_inserter(filter_rows.rows_),
               [&, at = column_index(column)](const std::vector<TableEntry>& row) {
                 return holds(row[at]);
               });
  return filter_rows;
}

std::vector<Table> Table::rows() const {
  std::vector<Table> rows(rows_.size(), Table(columns_));
  for (std::size_t i = 0; i < rows_.size(); ++i) rows[i].rows_.push_back(rows_[i]);
  return rows;
}

std::vector<TableEntry> Table::entries(const std::string& column) const {
  const std::size_t at = column_index(column);
  std::vector<TableEntry> entries;
  for (const auto& row : rows_) entries.push_back(row[at]);
  return entries;
}

std::vector<TableEntry> Table::unique(const std::string& column) const {
  std::vector<TableEntry> unique;
  for (const TableEntry& entry : entries(column))
    if (std::find(unique.begin(), unique.end(), entry) == unique.end()) unique.push_back(entry);
  return unique;
}

std::vector<double> Table::numbers(const std::string& column) const {
  std::vector<double> numbers;
  for (const TableEntry& entry : entries(column)) {
    if (!entry.is_number())
      throw Error(
          fmt::format("table: '{}' in column '{}'; accepted: a number", entry.text(), column));
    numbers.push_back(entry.number());
  }
  return numbers;
}

TableEntry Table::entry(const std::string& column) const {
  const std::vector<TableEntry> all = entries(column);
  if (all.size() != 1)
    throw Error(fmt::format("table: column '{}' of {} rows; accepted: of one", column, all.size()));
  return all.front();
}

double Table::number(const std::string& column) const {
  entry(column);  // refuses more rows than one, or none
  return numbers(column).front();
}

double Table::min(const std::string& column) const {
  return some(*this, column).minCoeff<Eigen::PropagateNaN>();
}
double Table::max(const std::string& column) const {
  return some(*this, column).maxCoeff<Eigen::PropagateNaN>();
}
double Table::first(const std::string& column) const { return some(*this, column)(0); }
double Table::last(const std::string& column) const { return some(*this, column).tail<1>()(0); }

double Table::order(const std::string& y, const std::string& x) const {
  for (const std::string& column : {y, x})
    for (const double value : numbers(column))
      if (!(value > 0 && std::isfinite(value)))
        throw Error(fmt::format("table: order of {} in column '{}'; accepted: a number > 0", value,
                                column));
  if (unique(x).size() < 2)
    throw Error(fmt::format("table: order of '{}' in '{}' from {} places; accepted: two or more", y,
                            x, unique(x).size()));
  return slope(numbers(x), numbers(y));
}

std::vector<double> Table::pairwise_orders(const std::string& y, const std::string& x) const {
  std::vector<double> orders;
  for (int i = 0; i + 1 < size(); ++i) {
    Table pair(columns_);
    pair.rows_ = {rows_[i], rows_[i + 1]};
    orders.push_back(pair.order(y, x));
  }
  return orders;
}

Table Table::pivot(const std::string& rows, const std::string& across,
                   const std::string& value) const {
  const std::vector<TableEntry> down = unique(rows), right = unique(across);
  std::vector<std::string> columns{rows};
  for (const int digits : {4, 0}) {  // rounded, unless two of them become one
    columns.resize(1);
    for (const TableEntry& entry : right) columns.push_back(entry.text(digits));
    if (std::set<std::string>(columns.begin(), columns.end()).size() == columns.size()) break;
  }
  Table pivoted(std::move(columns));
  for (const TableEntry& name : down) {
    const Table line = filter(rows, name);
    std::vector<TableEntry> row{name};
    for (const TableEntry& entry : right) {
      const std::vector<TableEntry> here = line.filter(across, entry).entries(value);
      if (here.size() > 1)
        throw Error(fmt::format("table: {} entries for {} = {}, {} = {}; accepted: one",
                                here.size(), rows, name.text(), across, entry.text()));
      row.push_back(here.empty() ? TableEntry("") : here.front());
    }
    pivoted.add(std::move(row));
  }
  return pivoted;
}

Table Table::select(const std::vector<std::string>& columns) const {
  Table selected(columns);
  selected.rows_.resize(rows_.size());
  for (const std::string& column : columns)
    for (std::size_t i = 0; const TableEntry& entry : entries(column))
      selected.rows_[i++].push_back(entry);
  return selected;
}

std::string Table::text(int digits) const {
  std::vector<std::string> lines(rows_.size() + 1);
  for (std::size_t at = 0; at < columns_.size(); ++at) {
    std::vector<std::string> words{columns_[at]};
    for (const auto& row : rows_) words.push_back(row[at].text(digits));
    std::size_t width = 0;
    for (const std::string& word : words) width = std::max(width, word.size());
    const bool left = std::none_of(rows_.begin(), rows_.end(),
                                   [&](const auto& row) { return row[at].is_number(); });
    for (std::size_t i = 0; i < lines.size(); ++i)
      lines[i] += left ? fmt::format("  {:<{}}", words[i], width)
                       : fmt::format("  {:>{}}", words[i], width);
  }
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

void Table::print(const std::string& title, int digits) const {
  const std::string heading = title.empty() ? "" : "  " + title + "\n";
  fmt::print("\n{}{}\n", heading, text(digits));
  std::fflush(stdout);
}

void Table::write(const std::filesystem::path& path) const {
  write_file(path, [&](std::ostream& out) {
    Text text(out);
    const auto line = [&](const std::vector<TableEntry>& row) {
      for (std::size_t i = 0; i < row.size(); ++i)
        text.print("{}{}", i > 0 ? "," : "", in_csv(row[i].text()));
      text.print("\n");
    };
    line({columns_.begin(), columns_.end()});
    for (const auto& row : rows_) line(row);
  });
}

}  // namespace antilock
