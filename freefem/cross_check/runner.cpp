#include "runner.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "antilock/core/error.hpp"
#include "programs/program.hpp"

namespace antilock::freefem {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields{""};
  for (const char c : line)
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  return fields;
}

}  // namespace

void run(const std::string& script, const std::vector<std::string>& options) {
  using tutorial::in_shell;
  std::string command =
      fmt::format("{} {}", in_shell(ANTILOCK_FREEFEM_FOLDER "/run"), in_shell(script));
  for (const std::string& option : options) command.append(" ").append(in_shell(option));
  command.append(" 2>&1 >/dev/null");  // standard error alone
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw Error("freefem/run cannot be started");
  std::string words;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe))
    words += c == '\n' ? ' ' : static_cast<char>(c);
  const int status = pclose(pipe);
  if (status ==
      0) {  // FreeFEM is there and new enough: freefem/run does not start it once more to ask
    const char* program = std::getenv("FREEFEM");
    ::setenv("FREEFEM_CHECKED", program == nullptr ? "FreeFem++" : program, 1);
    return;
  }
  words.erase(words.find_last_not_of(' ') + 1);
  if (words.empty())
    words = fmt::format("freefem/run {} ended with status {}", script, WEXITSTATUS(status));
  throw Error(words);
}

void check() { run("--check", {}); }

Eigen::VectorXd ScriptTable::column(const std::string& name) const {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) throw Error("table: no column " + name);
  return rows.col(found - header.begin());
}

ScriptTable read_table(const std::filesystem::path& path, int text) {
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line)) throw Error(path.string() + ": cannot be read, or is empty");
  ScriptTable table{split(line), {}, {}};
  if (static_cast<int>(table.header.size()) <= text)
    throw Error(path.string() + ": no column of numbers");
  std::vector<double> values;
  for (int number = 2; std::getline(in, line); ++number) {
    const auto fields = split(line);
    const std::string where = fmt::format("{}, line {}: ", path.string(), number);
    if (fields.size() != table.header.size())
      throw Error(where +
                  fmt::format("{} fields; accepted {}", fields.size(), table.header.size()));
    const auto numbers = fields.begin() + text;
    table.names.push_back(fmt::format("{}", fmt::join(fields.begin(), numbers, " ")));
    for (auto field = numbers; field != fields.end(); ++field) {
      char* end = nullptr;
      const double value = std::strtod(field->c_str(), &end);
      if (field->empty() || *end != '\0' || !std::isfinite(value))
        throw Error(where + "'" + *field + "' is no finite number");
      values.push_back(value);
    }
  }
  table.header.erase(table.header.begin(), table.header.begin() + text);
  const auto columns = static_cast<Eigen::Index>(table.header.size());
  using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  table.rows = Eigen::Map<const ByRows>(
      values.data(), static_cast<Eigen::Index>(values.size()) / columns, columns);
  return table;
}

}  // namespace antilock::freefem
