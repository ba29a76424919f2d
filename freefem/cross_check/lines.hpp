#pragma once
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace antilock::freefem {

constexpr double bound = 1e-8;  ///< of two solutions of one discrete problem

/// One line of the table.
struct Line {
  std::string tutorial, what;
  std::string road;  ///< how FreeFEM solved the stiff part
  int unknowns = 0;
  double difference = 0;         ///< relative, maximum norm
  std::string contact = "same";  ///< contact set
  double seconds = 0, freefem_seconds = 0;
  double bound = freefem::bound;  ///< infinity: shown, not asked to agree
  bool holds() const {
    return std::isinf(bound) || (difference <= bound && contact.find("other") == std::string::npos);
  }
};

/// The table, and the note under it.
std::string markdown(const std::vector<Line>& lines, double epsilon);
/// OUT/results.csv, and the markdown in `table`.
void write_files(const std::vector<Line>& lines, double epsilon, const std::filesystem::path& out,
                 const std::filesystem::path& table);

}  // namespace antilock::freefem
