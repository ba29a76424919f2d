#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace antilock::freefem {

/// Runs `freefem/run SCRIPT OPTIONS` and waits. Throws Error with the one line that it failed with.
void run(const std::string& script, const std::vector<std::string>& options);

/// Throws Error with one line where FreeFEM is missing, too old, or cannot solve a small system by
/// UMFPACK.
void check();

/// A table of numbers that a script wrote: one header line, then rows, comma separated.
struct ScriptTable {
  std::vector<std::string> header;
  Eigen::MatrixXd rows;
  std::vector<std::string>
      names;  ///< of the rows: their leading fields that are text, a space between them
  /// Throws Error where there is no such column.
  Eigen::VectorXd column(const std::string& name) const;
};
/// Throws Error, naming file and line, for a file that is missing, without a header, ragged, or
/// that holds anything but finite numbers in the fields behind the first `text`.
ScriptTable read_table(const std::filesystem::path& path, int text = 0);

}  // namespace antilock::freefem
