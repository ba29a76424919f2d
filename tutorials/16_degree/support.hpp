#pragma once
#include <filesystem>

#include "antilock/study/table.hpp"

namespace antilock::tutorial {

/// results.csv, and degree.csv for the picture: the series are named by the degree alone,
/// so that one degree has one colour in all panels.
inline void write_degrees(const std::filesystem::path& out, const Table& results) {
  results.select({"element", "mesh", "cells", "h", "unknowns", "cost", "h1", "kept", "law"})
      .write(out / "results.csv");
  Table picture({"mesh", "series", "unknowns", "h1"});
  for (const Table& row : results.rows())
    picture.add({row.entry("mesh"), "degree " + row.entry("degree").text(),
                 row.number("unknowns"), row.number("h1")});
  picture.write(out / "degree.csv");
}

}  // namespace antilock::tutorial
