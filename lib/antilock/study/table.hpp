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
  /// Returns the word, or the number as the shortest text that reads back as the same double. With
  /// `digits` a number is rounded to that many digits, except for whole numbers below 1e9.
  std::string text(int digits = 0) const;
  /// Numbers are equal if they are the same double.
  bool operator==(const TableEntry&) const = default;

 private:
  std::variant<double, std::string> value_;
};

/// The results of a study: named columns, one row per run. Entries are accessed by the names of
/// columns, not by positions. Every function throws Error for a column that the table does not
/// have, with the names of its columns.
class Table {
 public:
  /// Throws Error for a name that occurs twice.
  explicit Table(std::vector<std::string> columns);

  /// Throws Error unless there is one entry per column.
  void add(std::vector<TableEntry> row);
  /// Adds the rows of a table. Throws Error unless it has the same columns.
  void add(const Table& other);
  int size() const { return static_cast<int>(rows_.size()); }  ///< rows
  const std::vector<std::string>& columns() const { return columns_; }

  /// Each returns a part of the rows, in their order: those with `value` in this column, and those
  /// whose number in this column satisfies `holds`. filter_number throws Error for a column with
  /// words.
  Table filter(const std::string& column, const TableEntry& value) const;
  Table filter_number(const std::string& column, const std::function<bool(double)>& holds) const;
  /// Returns each row as a table with one row.
  std::vector<Table> rows() const;
  /// Return one column: all entries, the different entries in the order in which they occur first,
  /// and all entries as numbers. `numbers` throws Error for a word.
  std::vector<TableEntry> entries(const std::string& column) const;
  std::vector<TableEntry> unique(const std::string& column) const;
  std::vector<double> numbers(const std::string& column) const;
  /// Return the entry, or the number, of a table with one row. Throw Error if there are more rows
  /// or none.
  TableEntry entry(const std::string& column) const;
  double number(const std::string& column) const;
  /// Return the smallest, the largest, the first and the last number of a column. `min` and `max`
  /// are NaN if an entry is NaN. Throw Error for a table without rows.
  double min(const std::string& column) const;
  double max(const std::string& column) const;
  double first(const std::string& column) const;
  double last(const std::string& column) const;
  /// Returns the order of convergence, the least-squares slope of log(y) against log(x). Throws
  /// Error where there are fewer than two different x, or a number is not positive.
  double order(const std::string& y, const std::string& x) const;
  /// Returns the same for each pair of successive rows. Throws Error as `order` does, and for
  /// successive rows with the same x.
  std::vector<double> pairwise_orders(const std::string& y, const std::string& x) const;
  /// Returns a table with one row per different entry of `rows` and one column per different entry
  /// of `across`. Its entries are those of `value`, for example an error against h and epsilon. An
  /// entry without a value is an empty word. Throws Error if an entry has two values.
  Table pivot(const std::string& rows, const std::string& across, const std::string& value) const;
  /// Returns a table with only these columns, in this order.
  Table select(const std::vector<std::string>& columns) const;

  /// Returns the table as text in aligned columns. Columns of words are aligned to the left,
  /// columns with numbers to the right, and numbers are rounded to `digits`. `print` writes this
  /// text to standard output between two empty lines.
  std::string text(int digits = 4) const;
  void print(const std::string& title = "", int digits = 4) const;
  /// Writes a CSV file: a header, then the rows. A word with a comma, a quotation mark or a line
  /// break is quoted. If the writing fails, no part of the file is left.
  void write(const std::filesystem::path& path) const;

 private:
  std::size_t column_index(const std::string& column) const;
  Table filter_rows(const std::string& column,
                    const std::function<bool(const TableEntry&)>& holds) const;
  std::vector<std::string> columns_;
  std::vector<std::vector<TableEntry>> rows_;
};

}  // namespace antilock
