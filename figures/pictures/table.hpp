#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace antilock::figures {

/// A CSV file in memory: one header line, then rows with the same number of fields. A field may be
/// in double quotes.
class CsvTable {
 public:
  /// Throws Error with file and line if the file is missing, empty, without rows, or has rows of
  /// different lengths.
  explicit CsvTable(const std::filesystem::path& path);

  std::size_t rows() const { return rows_.size(); }
  /// Returns an entry. Throws Error where there is no such column.
  const std::string& text(std::size_t row, std::string_view column) const;
  /// Returns an entry as a number. `nan` and `inf` are accepted and mean a run without a solution.
  /// Throws Error for anything else.
  double number(std::size_t row, std::string_view column) const;
  /// Returns the distinct entries of a column, in the order of their first rows.
  std::vector<std::string> values(std::string_view column) const;

 private:
  std::size_t column_index(std::string_view column) const;
  std::string name_;
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace antilock::figures
