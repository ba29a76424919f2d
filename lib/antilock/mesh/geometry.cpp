#include "antilock/mesh/geometry.hpp"

#include <cstdio>
#include <istream>

#include "antilock/core/error.hpp"
#include "antilock/core/input_file.hpp"
#include "antilock/mesh/geometry_script.hpp"

namespace antilock {
namespace {

std::string text_of(std::istream& in) {
  constexpr std::streamsize most = 4 << 20;
  std::string text(most + 1, '\0');
  in.read(text.data(), most + 1);
  if (in.bad()) throw Error("cannot be read; accepted: a geometry script of gmsh");
  if (in.gcount() > most) throw Error("is larger than 4 MB; accepted: a geometry script of gmsh");
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

}  // namespace

Geometry read_geometry(const std::filesystem::path& file) {
  const std::filesystem::path kind = file.extension();
  const std::string name = printable(file.string(), 1000), accepted = "a .geo or .brep file";
  if (kind != ".geo" && kind != ".brep")
    throw Error(name + ": is neither .geo nor .brep; accepted: one of the two");
  const auto in = open_file(file, name, accepted);
  if (in->peek() == EOF) throw Error(name + ": is empty; accepted: " + accepted);
  try {
    return {file.string(), kind == ".geo" ? geometry_script(text_of(*in)) : ""};
  } catch (const Error& error) {
    throw Error(name + ": " + error.what());
  }
}

}  // namespace antilock
