#include "programs/subcommands/csv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <iterator>

#include "antilock/core/error.hpp"
#include "antilock/core/input_file.hpp"
#include "antilock/core/number.hpp"
#include "antilock/core/plain_text.hpp"

namespace antilock::subcommands {
namespace {

constexpr std::string_view blanks = " \t\r";

/// Without the blanks around it, then without a pair of quotes.
std::string_view trimmed(std::string_view entry) {
  const std::size_t first = entry.find_first_not_of(blanks);
  if (first == entry.npos) return {};
  entry = entry.substr(first, entry.find_last_not_of(blanks) - first + 1);
  const bool quoted = entry.size() >= 2 && entry.front() == '"' && entry.back() == '"';
  return quoted ? entry.substr(1, entry.size() - 2) : entry;
}

/// The entries of a line; a comma between quotes separates none.
std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> entries;
  std::size_t from = 0;
  bool quoted = false;
  for (std::size_t at = 0; at <= line.size(); ++at) {
    if (at < line.size() && line[at] == '"') quoted = !quoted;
    if (at < line.size() && (line[at] != ',' || quoted)) continue;
    entries.push_back(trimmed(line.substr(from, at - from)));
    from = at + 1;
  }
  return entries;
}

bool is_number(std::string_view entry) {
  double ignored = 0;
  return read_number(entry, ignored);
}

/// Why a first line is not the header that is accepted, as far as it can be told.
std::string_view header_fault(std::string_view line, const std::vector<std::string_view>& entries) {
  const std::string_view text = trimmed(line);
  if (text.starts_with('#')) return " behind a \"#\" (numpy.savetxt: comments=\"\" leaves it away)";
  if (text.find(';') != text.npos) return " with semicolons";
  if (text.find('\t') != text.npos) return " with tabs";
  if (std::all_of(entries.begin(), entries.end(), is_number))
    return ", which is no header but a row";
  return "";
}

/// The columns that the header names; throws Error for another header.
std::size_t read_header(std::string_view line, const std::vector<std::string>& header,
                        const CsvForm& form, const std::string& place,
                        const std::string& accepted) {
  const auto entries = split(line);
  const bool fits = entries.size() <= header.size() &&
                    entries.size() + form.optional_columns >= header.size() &&
                    std::equal(entries.begin(), entries.end(), header.begin());
  if (!fits)
    throw Error(fmt::format("{}: the header is \"{}\"{}; {}", place, printable(trimmed(line)),
                            header_fault(line, entries), accepted));
  return entries.size();
}

}  // namespace

CsvTable read_csv_table(std::istream& in, const std::string& name,
                        const std::vector<std::string>& header, const CsvForm& form) {
  const std::string file{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  std::string_view text = plain_text(file, name);
  std::string headers = fmt::format("{}", fmt::join(header, ","));
  for (std::size_t left = header.size() - form.optional_columns; left < header.size(); ++left)
    headers = fmt::format(
        "{} or {}", fmt::join(header.begin(), header.begin() + std::ptrdiff_t(left), ","), headers);
  const std::string accepted = fmt::format(
      "accepted: the header {}, then one row of as many numbers per line, with "
      "commas between them",
      headers);
  CsvTable table;
  std::vector<double> numbers;
  std::size_t columns = 0;
  for (int n = 1; !text.empty(); ++n) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (trimmed(line).empty()) continue;
    const std::string place = fmt::format("{}: line {}", name, n);
    if (columns == 0) {
      columns = read_header(line, header, form, place, accepted);
      continue;
    }
    const auto entries = split(line);
    if (entries.size() != columns)
      throw Error(fmt::format("{}: {} entries; {}", place, entries.size(), accepted));
    for (const std::string_view entry : entries) {
      double value = 0;
      const bool number = read_number(entry, value) && !std::isnan(value) &&
                          (form.infinite || std::isfinite(value));
      if (!number)
        throw Error(fmt::format("{}: \"{}\" is no {}number; {}", place, printable(entry, 40),
                                form.infinite ? "" : "finite ", accepted));
      numbers.push_back(value);
    }
    table.line.push_back(n);
  }
  if (columns == 0) throw Error(fmt::format("{}: empty; {}", name, accepted));
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  table.numbers = Eigen::Map<RowMajor>(numbers.data(), static_cast<Eigen::Index>(table.line.size()),
                                       static_cast<Eigen::Index>(columns));
  return table;
}

CsvTable read_csv_table(const std::string& path, const std::vector<std::string>& header,
                        const CsvForm& form) {
  return read_csv_table(*open_file(path, path, "a CSV file"), path, header, form);
}

Eigen::MatrixXd read_csv(std::istream& in, const std::string& name,
                         const std::vector<std::string>& header) {
  return read_csv_table(in, name, header).numbers;
}
Eigen::MatrixXd read_csv(const std::string& path, const std::vector<std::string>& header) {
  return read_csv_table(path, header).numbers;
}

}  // namespace antilock::subcommands
