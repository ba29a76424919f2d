#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace antilock {

/// One entry of a table: a number or a word.
class TableEntry {
 public:
  template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
  TableEntry(Number number) : value_(static_cast<double>(number)) {}
  TableEntry(std::string word) : value_(std::move(word)) {}
  TableEntry(const char* word) : value_(std::string(word)) {}

  bool is_number() const { return std::holds_alternative<double>(value_); }
  double number() const { return std::get<double>(value_); }
  /// A number as the shortest text that reads back as the same double, or rounded to `digits` (whole numbers
  /// below 1e9 are not).
  std::string text(int digits = 0) const;
  bool operator==(const TableEntry&) const = default;  ///< of numbers: the same double

 private:
  std::variant<double, std::string> value_;
};

/// The results of a study: named columns, one row per run. What is asked of it is asked by name, never by position.
/// Every function throws Error for a column that the table does not have, with the names of those that it has.
class Table {
 public:
  /// Throws Error for a name that comes twice.
  explicit Table(std::vector<std::string> columns);

  /// Throws Error unless there is one entry per column.
  void add(std::vector<TableEntry> row);
  /// Adds the rows of a table with the same columns, else throws Error.
  void add(const Table& other);
  int size() const { return static_cast<int>(rows_.size()); }  ///< rows
  const std::vector<std::string>& columns() const { return columns_; }

  /// The rows that hold `value` in this column, in their order; those whose number there satisfies `holds`.
  Table filter(const std::string& column, const TableEntry& value) const;
  Table filter_number(const std::string& column, const std::function<bool(double)>& holds) const;
  /// Each row as a table of its own.
  std::vector<Table> rows() const;
  /// One column: its entries; the different ones, in the order in which they occur; its numbers.
  std::vector<TableEntry> entries(const std::string& column) const;
  std::vector<TableEntry> unique(const std::string& column) const;
  std::vector<double> numbers(const std::string& column) const;
  /// The entry, or the number, in the one row of a table; throws Error where there are more or none.
  TableEntry entry(const std::string& column) const;
  double number(const std::string& column) const;
  /// The smallest, the largest (NaN where an entry is NaN), the first and the last number of a column. Throws Error for
  /// a table without rows.
  double min(const std::string& column) const;
  double max(const std::string& column) const;
  double first(const std::string& column) const;
  double last(const std::string& column) const;
  /// The order of convergence: least-squares slope of log(y) against log(x). Throws Error where there are fewer than
  /// two different x, or a number is not positive.
  double order(const std::string& y, const std::string& x) const;
  /// The same between each two rows that follow each other. Throws Error as `order` does, and for two rows of one x.
  std::vector<double> pairwise_orders(const std::string& y, const std::string& x) const;
  /// One row per different entry of `rows`, one column per different entry of `across`, filled with `value`: a table of
  /// an error against h and epsilon. Throws Error where a place is filled twice; an empty place holds no text.
  Table pivot(const std::string& rows, const std::string& across, const std::string& value) const;
  /// These columns alone, in this order.
  Table select(const std::vector<std::string>& columns) const;

  /// Aligned columns, words to the left, numbers to the right and rounded to `digits`; `print` puts them on standard
  /// output between two empty lines.
  std::string text(int digits = 4) const;
  void print(const std::string& title = "", int digits = 4) const;
  /// CSV, whole or not at all: a header, then the rows; a word that holds a comma or a quotation mark is quoted.
  void write(const std::filesystem::path& path) const;

 private:
  std::size_t column_index(const std::string& column) const;
  Table filter_rows(const std::string& column, const std::function<bool(const TableEntry&)>& holds) const;
  std::vector<std::string> columns_;
  std::vector<std::vector<TableEntry>> rows_;
};

}  // namespace antilock
