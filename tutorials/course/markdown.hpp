#pragma once
#include "antilock/core/atomic_file.hpp"
#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// Writes the words, then the table, as Markdown: the price lists of chapters 21 and 22.
inline void write_markdown(const std::filesystem::path& file, const std::string& words,
                           const Table& table) {
  std::string head = "|", rule = "|", body;
  for (const std::string& column : table.columns())
    head += ' ' + column + " |", rule += "---|";
  for (const Table& row : table.rows()) {
    body += '|';
    for (const std::string& column : table.columns())
      body += ' ' + row.entry(column).text() + " |";
    body += '\n';
  }
  write_file(file, [&](std::ostream& out) {
    out << words << "\n\n" << head << '\n' << rule << '\n' << body;
  });
}

}  // namespace antilock::tutorial
