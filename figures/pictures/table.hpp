#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace antilock::figures {

/// A CSV file in memory: one header line, then rows of as many fields; a field may stand in double
/// quotes.
class CsvTable {
 public:
  /// Throws Error, naming file and line, for a file that is missing, empty, without rows or ragged.
  explicit CsvTable(const std::filesystem::path& path);

  std::size_t rows() const { return rows_.size(); }
  /// Throws Error where there is no such column.
  const std::string& text(std::size_t row, std::string_view column) const;
  /// A number; `nan` and `inf` are accepted and mean a run without an answer. Throws Error for
  /// anything else.
  double number(std::size_t row, std::string_view column) const;
  /// The different entries of a column, in the order in which they come.
  std::vector<std::string> values(std::string_view column) const;

 private:
  std::size_t column_index(std::string_view column) const;
  std::string name_;
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace antilock::figures
