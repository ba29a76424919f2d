#include "antilock/io/scene_file.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <optional>

#include "antilock/io/expression.hpp"

namespace antilock {
namespace {

using Names = std::initializer_list<std::string>;

/// A section of the file: gives its values, each checked, and refuses with the name of the file and of the key.
class Section {
 public:
  Section(std::string file, std::string name, const toml::table& table)
      : file_(std::move(file)), name_(std::move(name)), table_(table) {}

  [[noreturn]] void refuse(const std::string& key, const std::string& why) const { throw Error(where(key) + why); }
  std::string where(const std::string& key) const {
    std::string full = name_;
    if (!full.empty() && !key.empty()) full += '.';
    return printable(file_, 1000) + ": " + full + printable(key) + ": ";
  }

  void only(Names accepted) const {
    for (const auto& [key, value] : table_)
      if (const std::string name(key.str()); std::find(accepted.begin(), accepted.end(), name) == accepted.end())
        refuse(name, fmt::format("unknown {}; accepted: {}", name_.empty() ? "key or section" : "key",
                                 fmt::join(accepted, ", ")));
  }
  bool has(const std::string& key) const { return table_.contains(key); }

  std::string text(const std::string& key, const std::string& accepted) const {
    const auto value = table_[key].value_exact<std::string>();
    if (!value) refuse(key, what_stands_there(key) + "; accepted: " + accepted);
    return *value;
  }
  std::string one_of(const std::string& key, Names accepted) const {
    const std::string list = fmt::format("\"{}\"", fmt::join(accepted, "\", \""));
    const std::string value = text(key, list);
    if (std::find(accepted.begin(), accepted.end(), value) == accepted.end())
      refuse(key, fmt::format("\"{}\" is unknown; accepted: {}", printable(value), list));
    return value;
  }
  double number(const std::string& key, const std::string& accepted) const {
    std::optional<double> value = table_[key].value_exact<double>();
    if (const auto integer = table_[key].value_exact<std::int64_t>()) value = static_cast<double>(*integer);
    if (!value) refuse(key, what_stands_there(key) + "; accepted: a number, " + accepted);
    if (!std::isfinite(*value)) refuse(key, "is not finite; accepted: a number, " + accepted);
    return *value + 0.0;  // -0.0 becomes 0.0
  }
  int count(const std::string& key, int most) const {
    const std::string accepted = fmt::format("; accepted: a whole number, 1 to {}", most);
    const auto value = table_[key].value_exact<std::int64_t>();
    if (!value) refuse(key, what_stands_there(key) + accepted);
    if (*value < 1 || *value > most) refuse(key, fmt::format("{} is out of range{}", *value, accepted));
    return static_cast<int>(*value);
  }
  std::optional<Section> section(const std::string& key) const {
    if (!has(key)) return std::nullopt;
    const toml::table* table = table_[key].as_table();
    if (table == nullptr) refuse(key, fmt::format("{}; accepted: a section [{}]", what_stands_there(key), key));
    return Section(file_, key, *table);
  }

 private:
  std::string what_stands_there(const std::string& key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return "is missing";
    std::ostringstream type;
    type << node->type();
    return "is of type " + type.str();
  }

  std::string file_, name_;
  const toml::table& table_;
};

/// The whole file, up to a megabyte: a scene is a page, and some files never end.
std::string read_text(const std::filesystem::path& path, const std::string& name) {
  constexpr std::streamsize most = 1 << 20;
  const std::string accepted = "; accepted: a scene file in TOML";
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    throw Error(name + ": file: is a folder or a device" + accepted);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(name + ": file: cannot be opened" + accepted);
  std::string text(most + 1, '\0');
  in.read(text.data(), most + 1);
  if (in.bad()) throw Error(name + ": file: cannot be read" + accepted);
  if (in.gcount() > most) throw Error(name + ": file: is larger than 1 MB" + accepted);
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

toml::table parse(const std::string& text, const std::string& name) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw Error(fmt::format("{}: syntax: line {}, column {}: {}; accepted: TOML 1.0", name, error.source().begin.line,
                            error.source().begin.column, printable(std::string(error.description()), 200)));
  }
}

/// An expression whose every failure names the file and the key.
Expression expression(const Section& section, const std::string& key, const std::string& text,
                      const std::vector<std::string>& variables) {
  try {
    return Expression(text, variables);
  } catch (const Error& error) {
    section.refuse(key, error.what());
  }
}

/// f, evaluated once on lattices of the closed square that hold the corners, the edges, and every x and y of one or two
/// decimals or of a denominator up to 6: there the poles of formulas written by hand are found.
Field read_load(const Section& section) {
  section.only({"f"});
  const std::string accepted = "an expression in x and y in quotes, as \"10*sin(2*pi*x)\"";
  const Expression f = expression(section, "f", section.text("f", accepted), {"x", "y"});
  const Field field = [f, where = section.where("f")](double x, double y) {
    try {
      return f(x, y);
    } catch (const Error& error) {
      throw Error(where + error.what());
    }
  };
  for (const int n : {100, 120, 128})
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) field(static_cast<double>(i) / n, static_cast<double>(j) / n);
  return field;
}

UnilateralContact read_contact(const Section& section) {
  section.only({"gap"});
  const std::string text = section.has("gap") ? section.text("gap", "an expression in x in quotes, as \"0.01\"") : "0";
  const Expression gap = expression(section, "gap", text, {"x"});
  const Profile profile = [gap, where = section.where("gap")](double x) {
    try {
      return gap(x);
    } catch (const Error& error) {
      throw Error(where + error.what());
    }
  };
  for (const int n : {1000, 3840, 4096})
    for (int i = 0; i <= n; ++i) profile(static_cast<double>(i) / n);
  return {profile};
}

Layer read_layer(const Section& section) {
  section.only({"epsilon", "model"});
  const std::string model = section.has("model") ? section.one_of("model", {"scaled", "ventcel", "thin"}) : "scaled";
  const std::string accepted = model == "scaled"    ? "0 < epsilon <= 1, or exactly 0 (the rigid limit)"
                               : model == "ventcel" ? "exactly 0 (the model is the limit epsilon = 0)"
                                                    : "1e-3 <= epsilon <= 1 (below, use the scaled model)";
  const double epsilon = section.number("epsilon", accepted);
  const double least = model == "thin" ? 1e-3 : 0, most = model == "ventcel" ? 0 : 1;
  if (!(epsilon >= least && epsilon <= most))
    section.refuse("epsilon",
                   fmt::format("{} is out of range for model = \"{}\"; accepted: {}", epsilon, model, accepted));
  if (model == "ventcel") return VentcelLayer{};
  if (model == "thin") return ThinLayer{epsilon};
  return StiffLayer{epsilon};
}

MeshRequest read_mesh(const Section& section, const std::filesystem::path& folder) {
  section.only({"kind", "cells", "file"});
  const std::string kind = section.one_of("kind", {"structured", "unstructured", "file"});
  MeshRequest request;
  if (kind == "file") {
    request.kind = MeshRequest::Kind::file;
    if (section.has("cells")) section.refuse("cells", "does not go with kind = \"file\"; accepted: file alone");
    const std::string accepted = "the path of a MSH file, 2.2 or 4.1, relative to the scene file";
    const std::string path = section.text("file", accepted);
    if (path.empty() || path.find('\0') != path.npos) section.refuse("file", "is no path; accepted: " + accepted);
    request.file = folder / path;
    return request;
  }
  request.kind = kind == "structured" ? MeshRequest::Kind::structured : MeshRequest::Kind::unstructured;
  if (section.has("file"))
    section.refuse("file", fmt::format("does not go with kind = \"{}\"; accepted: with kind = \"file\" only", kind));
  request.cells = section.count("cells", kind == "structured" ? 2048 : 512);
  return request;
}

Method read_method(const Section& section) {
  section.only({"element", "solver", "tolerance"});
  Method method;
  if (section.has("element")) method.element = section.one_of("element", {"P1", "CR"});
  if (section.has("solver")) method.solver = section.one_of("solver", {"active-set", "uzawa", "petsc"});
  if (!section.has("tolerance")) return method;
  method.tolerance = section.number("tolerance", "0 < tolerance < 1");
  if (!(method.tolerance > 0 && method.tolerance < 1))
    section.refuse("tolerance", fmt::format("{} is out of range; accepted: 0 < tolerance < 1", method.tolerance));
  return method;
}

}  // namespace

SceneFile read_scene_file(const std::filesystem::path& path) {
  return read_scene(read_text(path, printable(path.string(), 1000)), path);
}

SceneFile read_scene(const std::string& text, const std::filesystem::path& path) {
  const std::string name = printable(path.string(), 1000);
  const toml::table table = parse(text, name);
  const Section root(name, "", table);
  root.only({"title", "load", "layer", "contact", "mesh", "method"});
  for (const std::string required : {"load", "mesh"})
    if (!root.has(required)) root.refuse(required, fmt::format("is missing; accepted: a section [{}]", required));

  const std::string title = root.has("title") ? root.text("title", "any text in quotes") : "";
  const Body body{read_load(*root.section("load"))};
  const auto layer_section = root.section("layer"), contact_section = root.section("contact");
  const Layer layer = layer_section ? read_layer(*layer_section) : NoLayer{};
  const auto contact = contact_section ? std::optional(read_contact(*contact_section)) : std::nullopt;
  const MeshRequest mesh = read_mesh(*root.section("mesh"), path.parent_path());
  const auto method_section = root.section("method");
  const Method method = method_section ? read_method(*method_section) : Method{};
  try {
    return {name, title, Scene(body, layer, contact), mesh, method};
  } catch (const Error& error) {  // what is left for the scene to refuse: a gap that no clamped end can keep
    throw Error(contact_section->where("gap") + error.what());
  }
}

}  // namespace antilock
