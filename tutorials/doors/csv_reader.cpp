#include "doors/csv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "antilock/core/error.hpp"

namespace antilock::doors {
namespace {

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> parts;
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t comma = std::min(line.find(',', from), line.size());
    std::string_view part = line.substr(from, comma - from);
    while (!part.empty() && part.front() == ' ') part.remove_prefix(1);
    while (!part.empty() && (part.back() == ' ' || part.back() == '\r')) part.remove_suffix(1);
    parts.push_back(part);
    from = comma + 1;
  }
  return parts;
}

}  // namespace

Eigen::MatrixXd read_csv(std::istream& in, const std::string& name, const std::vector<std::string>& header) {
  const std::string accepted = fmt::format("accepted: the header {}, then one row of {} numbers per line",
                                           fmt::join(header, ","), header.size());
  std::vector<double> numbers;
  std::string line;
  bool headed = false;
  for (int n = 1; std::getline(in, line); ++n) {
    const auto parts = split(line);
    if (parts.size() == 1 && parts[0].empty()) continue;
    if (!headed) {
      if (!std::equal(parts.begin(), parts.end(), header.begin(), header.end()))
        throw Error(fmt::format("{}: line {}: the header is \"{:.60}\"; {}", name, n, line, accepted));
      headed = true;
      continue;
    }
    if (parts.size() != header.size())
      throw Error(fmt::format("{}: line {}: {} entries; {}", name, n, parts.size(), accepted));
    for (const std::string_view part : parts) {
      double value = 0;
      const auto [end, error] =
          std::from_chars(part.data() + (part.starts_with('+') ? 1 : 0), part.data() + part.size(), value);
      if (error != std::errc() || end != part.data() + part.size() || !std::isfinite(value))
        throw Error(fmt::format("{}: line {}: \"{:.40}\" is no finite number; {}", name, n, part, accepted));
      numbers.push_back(value);
    }
  }
  if (!headed) throw Error(fmt::format("{}: empty; {}", name, accepted));
  const auto columns = static_cast<Eigen::Index>(header.size());
  return Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      numbers.data(), static_cast<Eigen::Index>(numbers.size()) / columns, columns);
}

Eigen::MatrixXd read_csv(const std::string& path, const std::vector<std::string>& header) {
  std::ifstream in(path);
  if (!in) throw Error(path + ": cannot be opened; accepted: a CSV file");
  return read_csv(in, path, header);
}

}  // namespace antilock::doors
