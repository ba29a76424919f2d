#pragma once
#include <Eigen/Core>
#include <istream>
#include <string>
#include <vector>

#include "antilock/core/eigen_memory.hpp"

namespace antilock::subcommands {

/// A table of numbers, and for each row its line in the file, counted from 1.
struct CsvTable {
  Eigen::MatrixXd numbers;  ///< rows x columns
  std::vector<int> line;
};

/// The accepted form of a table: how many of the last columns may be absent (with their headers),
/// and whether a number may be infinite ("inf", "-inf").
struct CsvForm {
  std::size_t optional_columns = 0;
  bool infinite = false;
};

/// Reads a table with this header line, separated by commas, one row per line. A byte order mark,
/// spaces and tabs, quotes around an entry, a plus sign and empty lines are accepted. Throws Error,
/// `NAME: line N: what is wrong; accepted: ...`, for another header (none, one behind "#", one with
/// semicolons), another number of entries, an entry that is no number, or a text in UTF-16.
CsvTable read_csv_table(std::istream& in, const std::string& name,
                        const std::vector<std::string>& header, const CsvForm& form = {});
/// Does the same for a file. Throws Error also where it cannot be opened.
CsvTable read_csv_table(const std::string& path, const std::vector<std::string>& header,
                        const CsvForm& form = {});

/// Do the same, and return only the numbers.
Eigen::MatrixXd read_csv(std::istream& in, const std::string& name,
                         const std::vector<std::string>& header);
Eigen::MatrixXd read_csv(const std::string& path, const std::vector<std::string>& header);

}  // namespace antilock::subcommands
