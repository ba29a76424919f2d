#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace antilock::freefem {

constexpr double bound = 1e-8;

/// One line of the table.
struct Line {
  std::string tutorial, what;
  std::string road;  ///< how FreeFEM solved the stiff part
  int unknowns = 0;
  double difference = 0;         ///< relative, maximum norm
  std::string contact = "same";  ///< contact set
  double seconds = 0, freefem_seconds = 0;
  bool bounded = true;  ///< the difference is asked to be below the bound
  bool holds() const { return !bounded || (difference <= bound && contact.find("other") == std::string::npos); }
};

/// The table, and the note under it.
std::string markdown(const std::vector<Line>& lines, double epsilon);
/// OUT/results.csv, and the markdown in `table`.
void write_files(const std::vector<Line>& lines, double epsilon, const std::filesystem::path& out,
                 const std::filesystem::path& table);

}  // namespace antilock::freefem
