#include "antilock/io/scene_file.hpp"

#include <fmt/format.h>

#include <fstream>

#include "antilock/io/detail/scene_checks.hpp"
#include "antilock/io/detail/scene_section.hpp"
#include "antilock/io/expression.hpp"

namespace antilock {
namespace {

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

Field read_load(const Section& section, SceneWords& words) {
  section.only({"f"});
  words.load = section.text("f", "an expression in x and y in quotes, as \"10*sin(2*pi*x)\"");
  const Expression f = expression(section, "f", words.load, {"x", "y"});
  return [f, where = section.where("f")](double x, double y) {
    try {
      return f(x, y);
    } catch (const Error& error) {
      throw Error(where + error.what());
    }
  };
}

UnilateralContact read_contact(const Section& section, SceneWords& words) {
  section.only({"gap"});
  words.gap = section.has("gap") ? section.text("gap", "an expression in x in quotes, as \"0.01\"") : "0";
  const Expression gap = expression(section, "gap", words.gap, {"x"});
  return {[gap, where = section.where("gap")](double x) {
    try {
      return gap(x);
    } catch (const Error& error) {
      throw Error(where + error.what());
    }
  }};
}

Layer read_layer(const Section& section, SceneWords& words) {
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
  words.model = model;
  if (model == "ventcel") return VentcelLayer{};
  if (model == "thin") return ThinLayer{epsilon};
  return StiffLayer{epsilon};
}

constexpr int most_structured = 2048, most_unstructured = 512;

/// Absent: 0. With `cells` per unit side, those of the refined mesh are at most as many as a structured mesh may have.
int read_refinements(const Section& section, int cells) {
  if (!section.has("refinements")) return 0;
  const int refinements = section.count("refinements", 10);
  if (cells << refinements > most_structured)
    section.refuse("refinements", fmt::format("{} refinements of {} cells per unit side make {}; accepted: up to {}",
                                              refinements, cells, cells << refinements, most_structured));
  return refinements;
}

MeshRequest read_mesh(const Section& section, const std::filesystem::path& folder, SceneWords& words) {
  using Kind = MeshRequest::Kind;
  section.only({"kind", "cells", "file", "refinements"});
  words.mesh = section.one_of("kind", {"structured", "unstructured", "layered", "file"});
  if (words.mesh == "file") {
    if (section.has("cells")) section.refuse("cells", "does not go with kind = \"file\"; accepted: file alone");
    const std::string accepted = "the path of a MSH file, 2.2 or 4.1, relative to the scene file";
    words.file = section.text("file", accepted);
    if (words.file.empty() || words.file.find('\0') != words.file.npos)
      section.refuse("file", "is no path; accepted: " + accepted);
    return {Kind::file, 0, folder / words.file, read_refinements(section, 0)};
  }
  if (section.has("file"))
    section.refuse("file",
                   fmt::format("does not go with kind = \"{}\"; accepted: with kind = \"file\" only", words.mesh));
  const Kind kind = words.mesh == "structured"     ? Kind::structured
                    : words.mesh == "unstructured" ? Kind::unstructured
                                                   : Kind::layered;
  const int cells = section.count("cells", kind == Kind::structured ? most_structured : most_unstructured);
  return {kind, cells, {}, read_refinements(section, cells)};
}

/// An accuracy and what goes with it: the mesh is found, by Crouzeix-Raviart and the active set.
void read_accuracy(const Section& section, MethodRequest& method) {
  for (const char* key : {"of", "most_unknowns"})
    if (section.has(key) && !section.has("accuracy"))
      section.refuse(key, "goes with an accuracy only; accepted: a key accuracy beside it, or none of the two");
  if (!section.has("accuracy")) return;
  const std::string accepted = "above 0 and below 1, as 1e-2";
  method.accuracy = section.number("accuracy", accepted);
  if (!(*method.accuracy > 0 && *method.accuracy < 1))
    section.refuse("accuracy", fmt::format("{} is out of range; accepted: {}", *method.accuracy, accepted));
  if (section.has("of") && section.one_of("of", {"displacement", "stress"}) == "stress") method.of = Quantity::stress;
  if (section.has("most_unknowns")) {
    const std::string whole = "a whole number of unknowns, 1 to 1e9";
    method.most_unknowns = section.number("most_unknowns", whole);
    if (!(method.most_unknowns >= 1 && method.most_unknowns <= 1e9))
      section.refuse("most_unknowns", fmt::format("{} is out of range; accepted: {}", method.most_unknowns, whole));
  }
  method.tolerance =
      std::min(MethodRequest::roughest_tolerance, 1e-2 * *method.accuracy);  // unless the scene says less
  if (!section.has("element")) method.element = "CR";
  if (method.element != "CR")
    section.refuse("element",
                   "\"" + method.element + "\" has no flux to prove an accuracy by; accepted with accuracy: \"CR\"");
  if (method.solver != "active-set")
    section.refuse("solver", "\"" + method.solver + "\" does not go with accuracy; accepted: \"active-set\"");
}

MethodRequest read_method(const Section& section) {
  section.only({"element", "solver", "tolerance", "accuracy", "of", "most_unknowns"});
  MethodRequest method;
  if (section.has("element")) method.element = section.one_of("element", {"P1", "CR", "P2"});
  if (section.has("solver")) method.solver = section.one_of("solver", {"active-set", "uzawa", "petsc"});
  read_accuracy(section, method);
  if (!section.has("tolerance")) return method;
  const std::string accepted = fmt::format("0 < tolerance <= {:g}", MethodRequest::roughest_tolerance);
  method.tolerance = section.number("tolerance", accepted);
  if (!(method.tolerance > 0 && method.tolerance <= MethodRequest::roughest_tolerance))
    section.refuse("tolerance", fmt::format("{} is out of range; accepted: {}", method.tolerance, accepted));
  return method;
}

/// What one section leaves out because of another.
void check_together(const Section& root, const Scene& scene, const MeshRequest& mesh, const MethodRequest& method) {
  if (mesh.kind == MeshRequest::Kind::layered && !std::holds_alternative<StiffLayer>(scene.layer()))
    root.section("mesh")->refuse("kind",
                                 "\"layered\" is the mesh of the scaled layer, which this scene does not have; "
                                 "accepted: a section [layer] with model = \"scaled\", or \"unstructured\"");
  if (method.accuracy && std::holds_alternative<VentcelLayer>(scene.layer()))
    root.section("method")->refuse(
        "accuracy",
        "does not go with model = \"ventcel\"; accepted: model = \"scaled\" with epsilon = 0, "
        "which is the same problem");
  if (method.element == "P2" && method.solver == "petsc")
    root.section("method")->refuse("element", "\"P2\" does not go with solver = \"petsc\"; accepted: \"P1\", \"CR\"");
  if (method.element == "P2" && std::holds_alternative<VentcelLayer>(scene.layer()))
    root.section("method")->refuse("element", "\"P2\" does not go with model = \"ventcel\"; accepted: \"P1\", \"CR\"");
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
  SceneWords words;
  const MeshRequest mesh = read_mesh(*root.section("mesh"), path.parent_path(), words);
  const bool unit_square = mesh.kind != MeshRequest::Kind::file;  // what a file holds is known when it is read
  const Body body{read_load(*root.section("load"), words)};
  if (unit_square) sample_load(body.load);
  const auto layer_section = root.section("layer"), contact_section = root.section("contact");
  const Layer layer = layer_section ? read_layer(*layer_section, words) : NoLayer{};
  auto contact = contact_section ? std::optional(read_contact(*contact_section, words)) : std::nullopt;
  if (contact && unit_square) sample_gap(contact->gap, 0, 1);
  if (contact && !unit_square) contact->held.clear();
  const auto method_section = root.section("method");
  const MethodRequest method = method_section ? read_method(*method_section) : MethodRequest{};
  const Scene scene = [&] {
    try {
      return Scene(body, layer, contact);
    } catch (const Error& error) {  // what is left for the scene to refuse: a gap that no clamped end can keep
      throw Error(contact_section->where("gap") + error.what());
    }
  }();
  check_together(root, scene, mesh, method);
  return {name, title, scene, mesh, method, words};
}

}  // namespace antilock
