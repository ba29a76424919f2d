#include "antilock/mesh/geometry.hpp"

#include <fstream>

#include "antilock/core/error.hpp"
#include "antilock/mesh/geometry_script.hpp"

namespace antilock {
namespace {

std::string text_of(const std::filesystem::path& file) {
  constexpr std::streamsize most = 4 << 20;
  std::ifstream in(file, std::ios::binary);
  std::string text(most + 1, '\0');
  if (in) in.read(text.data(), most + 1);
  if (in.bad() || !in.is_open()) throw Error("cannot be read; accepted: a geometry script of gmsh");
  if (in.gcount() > most) throw Error("is larger than 4 MB; accepted: a geometry script of gmsh");
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

}  // namespace

Geometry read_geometry(const std::filesystem::path& file) {
  const std::filesystem::path kind = file.extension();
  try {
    if (kind != ".geo" && kind != ".brep") throw Error("is neither .geo nor .brep; accepted: one of the two");
    // the end of a pipe or of a device would never come
    if (std::error_code ignored; !std::filesystem::is_regular_file(file, ignored))
      throw Error("there is no such file; accepted: a .geo or .brep file");
    return {file.string(), kind == ".geo" ? geometry_script(text_of(file)) : ""};
  } catch (const Error& error) {
    throw Error(printable(file.string(), 1000) + ": " + error.what());
  }
}

}  // namespace antilock
