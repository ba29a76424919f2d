#include "antilock/runner/scene_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <sstream>
#include <variant>

#include "antilock/core/input_file.hpp"
#include "antilock/core/number.hpp"
#include "antilock/core/plain_text.hpp"
#include "antilock/measure/point_values.hpp"
#include "antilock/mesh/generate.hpp"
#include "antilock/runner/expression.hpp"
#include "antilock/runner/obstacle_check.hpp"
#include "antilock/runner/scene_keys.hpp"
#include "antilock/runner/toml_depth.hpp"

namespace antilock {
namespace {

using Names = std::vector<std::string>;

/// A section of the file: gives its values, each checked by the key's row of scene_keys(), and
/// refuses with the name of the file and of the key.
class Section {
 public:
  /// `name`: in messages; `kind`: in the table, where its sections of one kind have numbers.
  Section(std::string file, std::string name, const toml::table& table, std::string kind)
      : file_(std::move(file)), name_(std::move(name)), kind_(std::move(kind)), table_(table) {}

  [[noreturn]] void refuse(const std::string& key, const std::string& why) const {
    throw InputError(where(key) + why);
  }
  std::string where(const std::string& key) const {
    std::string full = name_;
    if (!full.empty() && !key.empty()) full += '.';
    return printable(file_, 1000) + ": " + full + printable(key) + ": ";
  }

  /// Refuses a key that is none of the section's; of [model], of one kind's.
  void only_its_keys(const std::string& model = {}) const {
    const Names accepted = key_names(kind_, model);
    for (const auto& [key, value] : table_)
      if (const std::string name(key.str());
          std::find(accepted.begin(), accepted.end(), name) == accepted.end())
        refuse(name,
               fmt::format("unknown {}; accepted: {}", name_.empty() ? "key or section" : "key",
                           fmt::join(accepted, ", ")));
  }
  bool has(const std::string& key) const { return table_.contains(key); }
  const toml::table& table() const { return table_; }
  const SceneKey& row(const std::string& key) const { return scene_key(kind_, key); }

  /// Here and below: where the key is absent, what its row has for that.
  std::string text(const std::string& key) const { return text(key, row(key).accepted); }
  std::string text(const std::string& key, const std::string& accepted) const {
    if (const auto& otherwise = row(key).otherwise; otherwise && !has(key)) return *otherwise;
    const auto value = table_[key].value_exact<std::string>();
    if (!value) refuse(key, what_stands_there(key) + "; accepted: " + accepted);
    return *value;
  }
  std::string one_of(const std::string& key) const {
    const Names& accepted = row(key).choices;
    const std::string list = fmt::format("\"{}\"", fmt::join(accepted, "\", \""));
    std::string value = text(key, list);
    if (std::find(accepted.begin(), accepted.end(), value) == accepted.end())
      refuse(key, fmt::format("\"{}\" is unknown; accepted: {}", printable(value), list));
    return value;
  }
  double number(const std::string& key) const {
    const SceneKey& of = row(key);
    if (double value = 0; !has(key) && of.otherwise && read_number(*of.otherwise, value))
      return value;
    const double value = number(key, of.accepted);
    if (of.range && !of.range->holds(value))
      refuse(key, fmt::format("{} is out of range; accepted: {}", value, of.accepted));
    return value;
  }
  /// A number of any size.
  double number(const std::string& key, const std::string& accepted) const {
    std::optional<double> value = table_[key].value_exact<double>();
    if (const auto integer = table_[key].value_exact<std::int64_t>())
      value = static_cast<double>(*integer);
    if (!value) refuse(key, what_stands_there(key) + "; accepted: a number, " + accepted);
    if (!std::isfinite(*value)) refuse(key, "is not finite; accepted: a number, " + accepted);
    return *value + 0.0;  // -0.0 becomes 0.0
  }
  int count(const std::string& key, int most, int least = 1) const {
    const std::string accepted = fmt::format("; accepted: a whole number, {} to {}", least, most);
    const auto value = table_[key].value_exact<std::int64_t>();
    if (!value) refuse(key, what_stands_there(key) + accepted);
    if (*value < least || *value > most)
      refuse(key, fmt::format("{} is out of range{}", *value, accepted));
    return static_cast<int>(*value);
  }
  int count(const std::string& key) const {
    const SceneKey::Range& range = *row(key).range;
    return count(key, static_cast<int>(range.most), static_cast<int>(range.least));
  }

  /// [key]; empty where it is absent.
  Section section(const std::string& key) const {
    static const toml::table absent;
    if (!has(key)) return {file_, key, absent, key};
    const toml::table* table = table_[key].as_table();
    if (table == nullptr)
      refuse(key, fmt::format("{}; accepted: a section [{}]", what_stands_there(key), key));
    return {file_, key, *table, key};
  }
  /// [[key]]: its tables, named key[0], key[1], ...
  std::vector<Section> sections(const std::string& key) const {
    std::vector<Section> all;
    if (!has(key)) return all;
    const toml::array* array = table_[key].as_array();
    if (array == nullptr || !(array->empty() || array->is_array_of_tables()))
      refuse(key, fmt::format("{}; accepted: sections [[{}]]", what_stands_there(key), key));
    for (const toml::node& node : *array)
      all.emplace_back(file_, fmt::format("{}[{}]", key, all.size()), *node.as_table(), key);
    return all;
  }

 private:
  std::string what_stands_there(const std::string& key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return "is missing";
    std::ostringstream type;
    type << node->type();
    return "is of type " + type.str();
  }

  std::string file_, name_, kind_;
  const toml::table& table_;
};

/// The whole file, up to a megabyte: a scene is a page, and some files never end.
std::string read_text(const std::filesystem::path& path, const std::string& name) {
  constexpr std::streamsize most = 1 << 20;
  const std::string accepted = "a scene file in TOML";
  std::unique_ptr<std::istream> in;
  try {
    in = open_file(path, name + ": file", accepted);
  } catch (const Error& error) {
    throw InputError(error.what());
  }
  std::string text(most + 1, '\0');
  in->read(text.data(), most + 1);
  if (in->bad()) throw InputError(name + ": file: cannot be read; accepted: " + accepted);
  if (in->gcount() > most)
    throw InputError(name + ": file: is larger than 1 MB; accepted: " + accepted);
  text.resize(static_cast<std::size_t>(in->gcount()));
  return text;
}

toml::table parse(const std::string& text, const std::string& name) {
  plain_text(text, name + ": syntax");  // TOML knows UTF-8 and its byte order mark alone
  check_toml_depth(text, name);
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}: syntax: line {}, column {}: {}; accepted: TOML 1.0", name,
                                 error.source().begin.line, error.source().begin.column,
                                 printable(std::string(error.description()), 200)));
  }
}

/// A point as text, by as many coordinates as the scene has.
std::string place_text(const Eigen::Vector3d& x, int dimension) {
  return fmt::format("({:g})", fmt::join(x.data(), x.data() + dimension, ", "));
}

/// A field or a profile: a text that does not parse, or a value that is not finite, is refused with
/// the file and the key.
auto named(const Section& section, const std::string& key,
           const std::vector<std::string>& variables, const std::string& accepted) {
  const std::string text = section.text(key, accepted);
  const auto naming = [where = section.where(key)](const auto& ask) {
    try {
      return ask();
    } catch (const Error& error) {
      throw InputError(where + error.what());
    }
  };
  return [=, f = naming([&] { return Expression(text, variables); })](auto... at) {
    return naming([&] { return f(at...); });
  };
}
std::string formula_in(const Names& variables) {
  return "an expression in " + in_words(variables) + " in quotes";
}
/// A function of x and y, in space of x, y and z.
Field field(const Section& section, const std::string& key, int dimension) {
  if (dimension == 3) {
    const Names variables{"x", "y", "z"};
    return [f = named(section, key, variables, formula_in(variables))](
               double x, double y, double z) { return f(x, y, z); };
  }
  return [f = named(section, key, {"x", "y"}, section.row(key).accepted)](double x, double y) {
    return f(x, y);
  };
}
/// A function of x, in space of x and y.
Profile profile(const Section& section, const std::string& key, int dimension) {
  if (dimension == 3) {
    const Names variables{"x", "y"};
    return [f = named(section, key, variables, formula_in(variables))](double x, double y) {
      return f(x, y);
    };
  }
  return [f = named(section, key, {"x"}, section.row(key).accepted)](double x) { return f(x); };
}
/// The same where negative values are refused, and 0 unless `zero_too`.
Field field_above(const Field& f, const std::string& where, bool zero_too, int dimension) {
  return [=](double x, double y, double z) {
    const double value = f(x, y, z);
    if (value < 0 || (value == 0 && !zero_too))
      throw InputError(fmt::format("{}is {:g} at {}; accepted: {} 0", where, value,
                                   place_text({x, y, z}, dimension),
                                   zero_too ? "at least" : "above"));
    return value;
  };
}

/// Asked on grids of the closed unit square that share few places, with every x and y of one or two
/// decimals or of a denominator up to 6: there the poles of formulas written by hand are met.
void sample_square(const Field& f) {
  for (const int n : {100, 120, 128})
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) f(static_cast<double>(i) / n, static_cast<double>(j) / n);
}
/// The same of the unit cube, with coordinates of one decimal, of twentieths, and of a denominator
/// up to 6 or of 8.
void sample_cube(const Field& f) {
  for (const int n : {20, 24, 30})
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        for (int k = 0; k <= n; ++k)
          f(static_cast<double>(i) / n, static_cast<double>(j) / n, static_cast<double>(k) / n);
}
void sample_load(const Field& f, int dimension) {
  if (dimension == 3)
    sample_cube(f);
  else
    sample_square(f);
}
/// A profile along the side of the square, or over the lowest face of the cube.
void sample_profile(const Profile& profile, int dimension) {
  if (dimension == 3) return sample_square(profile);
  for (const int n : {1000, 3840, 4096})
    for (int i = 0; i <= n; ++i) profile(static_cast<double>(i) / n);
}

Body read_body(const Section& root, int dimension) {
  const Section load = root.section("load"), body = root.section("body");
  load.only_its_keys();
  Body read{field(load, "f", dimension)};
  body.only_its_keys();
  if (root.has("body") && !body.table()["stiffness"].is_table())  // a table: read_groups
    read.stiffness =
        field_above(field(body, "stiffness", dimension), body.where("stiffness"), false, dimension);
  return read;
}

/// `stiffness = { left = 1, right = 10 }`: the surfaces of the file and their numbers, found by
/// place.
void read_groups(const Section& body, const MeshRequest& mesh, ExtraGroups& groups, Body& read) {
  if (!body.table()["stiffness"].is_table()) return;
  std::vector<double> numbers;
  const Section section = body.section("stiffness");
  for (const auto& [group, value] : section.table()) {
    const std::string& name = groups.bodies.emplace_back(group.str());
    numbers.push_back(section.number(name, "the stiffness of that group, above 0"));
    if (!(numbers.back() > 0))
      body.refuse("stiffness",
                  "is not above 0 on the group " + name + "; accepted: positive numbers");
  }
  struct Parts {
    std::vector<int> part;
    std::optional<PointValues> places;
  };
  read.stiffness = [=, parts = std::make_shared<Parts>(), where = body.where("stiffness")](
                       double x, double y, double z) {
    if (!parts->places) {  // asked for the first time
      Mesh read_again = read_msh(mesh.file.string(), groups, &parts->part);
      const CellKind kind = read_again.kind;
      parts->places.emplace(Space(std::move(read_again), p1(kind)));
    }
    const Eigen::Vector3d place(x, y, z);
    auto at = parts->places->locate(place, 1e-9);
    if (!at)  // beside the file's polygon, where refinement follows a curve
      at = parts->places->locate(place, 0.5);
    const int part = at ? parts->part[at->triangle] : -1;
    if (part < 0)
      throw InputError(fmt::format(
          "{}names no group of the {} at {}; accepted: all groups of the body", where,
          mesh.dimension == 3 ? "volume" : "surface", place_text(place, mesh.dimension)));
    return numbers[part];
  };
}

/// Whether the section names the sides of two bodies.
bool is_between_bodies(const Section& section) {
  return section.has("slave") || section.has("master") || section.has("method");
}

/// The contact of two bodies. Its sides become edges without another condition.
TwoBodyContact read_interface(const Section& section, ExtraGroups& groups,
                              std::vector<BoundaryCondition>& edges) {
  section.only_its_keys();
  if (section.has("ceiling"))
    section.refuse("ceiling", "does not go with two bodies; accepted: a gap alone");
  const auto side = [&](const std::string& key) {
    const std::string group = section.text(key);
    if (group == "clamped" || group == "contact" || group == "sigma" ||
        groups.curves.contains(group))
      section.refuse(key, fmt::format("\"{}\" has its condition already; accepted: another group",
                                      printable(group)));
    const EdgeTag tag = natural_group(static_cast<int>(edges.size()));
    groups.curves[group] = tag;
    edges.push_back({group});
    return tag;
  };
  TwoBodyContact contact;
  contact.slave = side("slave");
  contact.master = side("master");
  contact.gap = [gap = profile(section, "gap", 2)](double x, double) { return gap(x); };
  if (section.one_of("method") == "node to segment")
    contact.method = InterfaceMethod::node_to_segment;
  groups.needs_contact = false;
  return contact;
}

UnilateralContact read_contact(const Section& section, int dimension) {
  section.only_its_keys();
  UnilateralContact contact{profile(section, "gap", dimension)};
  if (section.has("ceiling")) contact.upper_obstacle = profile(section, "ceiling", dimension);
  return contact;
}

/// The numbers that a model of the layer accepts as its thickness epsilon.
struct ThicknessRange {
  double least;
  double most;
  std::string accepted;  ///< in words
};

/// `key`: epsilon, or thickness beside a stiffness.
ThicknessRange thickness_range(const std::string& model, const std::string& key) {
  if (model == "ventcel") return {0, 0, "exactly 0 (the model is the limit epsilon = 0)"};
  if (model == "thin") return {1e-3, 1, "1e-3 <= epsilon <= 1 (below, use the scaled model)"};
  // a thickness is not 0: the stiffness times it would be
  const double least = key == "thickness" ? 1e-300 : 0;
  return {least, 1, fmt::format("0 < {0} <= 1, or exactly 0 (the rigid limit)", key)};
}

/// The keys that stand in the section must go with its model, and with each other.
void check_layer_keys(const Section& section, const std::string& model, bool has_thickness) {
  for (const char* key : {"thickness", "stiffness", "load"})
    if (section.has(key) && model != "scaled")
      section.refuse(
          key,
          fmt::format("does not go with model = \"{}\"; accepted: with \"scaled\" only", model));
  if (has_thickness && section.has("epsilon"))
    section.refuse("epsilon",
                   "stands beside thickness or stiffness; accepted: epsilon, or the other two");
}

/// s = stiffness * thickness of the scaled layer.
double read_scaled_stiffness(const Section& section, double thickness) {
  const double stiffness = section.number("stiffness");
  if (!(stiffness > 0))
    section.refuse("stiffness", fmt::format("{}; accepted: above 0", stiffness));
  const double s = stiffness * thickness;
  if (!(s > 0))
    section.refuse(
        "stiffness",
        fmt::format("{} times the thickness {} is 0 in double precision; accepted: a product "
                    "above 0",
                    stiffness, thickness));
  return s;
}

Layer read_layer(const Section& section, int dimension) {
  section.only_its_keys();
  const std::string model = section.one_of("model");
  const bool has_thickness = section.has("thickness") || section.has("stiffness");
  check_layer_keys(section, model, has_thickness);
  const std::string key = has_thickness ? "thickness" : "epsilon";
  const ThicknessRange range = thickness_range(model, key);
  const double epsilon = section.number(key, range.accepted);
  if (!(epsilon >= range.least && epsilon <= range.most))
    section.refuse(key, fmt::format("{} is out of range for model = \"{}\"; accepted: {}", epsilon,
                                    model, has_thickness ? "0 < thickness <= 1" : range.accepted));
  if (model == "ventcel") return VentcelLayer{};
  if (model == "thin") return ThinLayer{epsilon};
  StiffLayer layer{epsilon};
  if (has_thickness) layer.s = read_scaled_stiffness(section, epsilon);
  if (section.has("load")) layer.load = field(section, "load", dimension);
  return layer;
}

std::vector<BoundaryCondition> read_edges(const std::vector<Section>& sections, ExtraGroups& groups,
                                          int dimension) {
  using Kind = BoundaryCondition::Kind;
  std::vector<BoundaryCondition> edges;
  for (const Section& section : sections) {
    section.only_its_keys();
    BoundaryCondition edge{section.text("group")};
    if (edge.group == "clamped" || edge.group == "contact" || edge.group == "sigma" ||
        groups.curves.contains(edge.group))
      section.refuse("group",
                     fmt::format("\"{}\" has its condition already; accepted: another group",
                                 printable(edge.group)));
    if (section.has("free") && section.table()["free"].value_exact<bool>() != true)
      section.refuse("free", "is not true; accepted: " + section.row("free").accepted);
    int conditions = section.has("free") ? 1 : 0;
    for (const auto& [key, kind] : {std::pair{"displacement", Kind::displacement},
                                    {"traction", Kind::traction},
                                    {"spring", Kind::spring}})
      if (section.has(key)) {
        ++conditions;
        edge.kind = kind;
        edge.value = field(section, key, dimension);
        if (kind == Kind::spring)
          edge.value = field_above(edge.value, section.where(key), true, dimension);
      }
    if (conditions != 1)
      section.refuse(
          "group",
          fmt::format("\"{}\" has {} conditions; accepted: exactly one of free, displacement, "
                      "traction, spring",
                      printable(edge.group), conditions));
    const auto k = static_cast<int>(edges.size());
    groups.curves[edge.group] =
        edge.kind == Kind::displacement ? dirichlet_group(k) : natural_group(k);
    edges.push_back(std::move(edge));
  }
  return edges;
}

/// A list of as many numbers as there are coordinates; nothing for another entry.
std::optional<Eigen::Vector3d> read_point(const toml::node& node, int dimension) {
  const toml::array* numbers = node.as_array();
  if (numbers == nullptr || numbers->size() != static_cast<std::size_t>(dimension)) return {};
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int k = 0; k < dimension; ++k) {
    const auto value = (*numbers)[static_cast<std::size_t>(k)].value<double>();
    if (!value || !std::isfinite(*value)) return {};
    point(k) = *value;
  }
  return point;
}

std::vector<Eigen::Vector3d> read_points(const Section& section, int dimension) {
  section.only_its_keys();
  const std::string accepted =
      "; accepted: " + (dimension == 3 ? "a list of places, as [[0.25, 0.5, -1.0]]"
                                       : section.row("points").accepted);
  const toml::array* list = section.table()["points"].as_array();
  if (list == nullptr) section.refuse("points", "is no list" + accepted);
  std::vector<Eigen::Vector3d> points;
  for (const toml::node& node : *list) {
    const std::optional<Eigen::Vector3d> point = read_point(node, dimension);
    if (!point) section.refuse("points", "has an entry that is no place" + accepted);
    points.push_back(*point);
  }
  return points;
}

/// The keys of all blocks that are pressed down, and their obstacle.
void read_loading(const Section& section, const std::optional<UnilateralContact>& contact,
                  BlockLoading& block) {
  block.prescribed_displacement = section.number("push");
  if (section.has("friction"))
    block.friction =
        [bound =
             field_above([of = profile(section, "friction", 2)](double x, double) { return of(x); },
                         section.where("friction"), true, 2)](double x) { return bound(x, 0); };
  if (contact) block.gap = contact->gap;
}

/// Coulomb's coefficient; 0 without the key. With it the bounds of u_x begin with the limit 0.
double read_coulomb(const Section& section, BlockLoading& block) {
  if (!section.has("coulomb")) return 0;
  const double coefficient = section.number("coulomb");
  if (section.has("friction"))
    section.refuse("coulomb", "stands beside friction; accepted: one of the two");
  block.friction = [](double) { return 0.0; };
  return coefficient;
}

RubberModel read_rubber(const Section& section, const std::optional<UnilateralContact>& contact) {
  section.only_its_keys("rubber");
  RubberModel rubber;
  read_loading(section, contact, rubber.block);
  rubber.coulomb = read_coulomb(section, rubber.block);
  rubber.block.epsilon = section.number("epsilon");
  return rubber;
}

CoatingModel read_coating(const Section& section, const std::optional<UnilateralContact>& contact,
                          const StiffLayer& layer) {
  section.only_its_keys("coating");
  CoatingModel coating;
  read_loading(section, contact, coating.block);
  coating.coulomb = read_coulomb(section, coating.block);
  const double young = section.number("young");
  const double nu = section.number("poisson");
  const Lame body{young * nu / ((1 + nu) * (1 - 2 * nu)), young / (2 * (1 + nu))};
  coating.block.body = body;
  coating.block.layer = {layer.s * body.lambda, layer.s * body.mu};
  coating.block.thickness = layer.epsilon;
  return coating;
}

/// [model], with the sections that its kinds share.
SceneModel read_model(const Section& section, const std::optional<UnilateralContact>& contact,
                      const std::optional<TwoBodyContact>& between, const Layer& layer) {
  if (section.one_of("kind") == AntiPlaneModel::traits.name) {
    section.only_its_keys();
    return between ? SceneModel(TwoBodyModel{*between}) : AntiPlaneModel{};
  }
  if (between)
    section.refuse("kind",
                   "\"plane strain\" does not go with two bodies; accepted: \"anti-plane\"");
  if (std::holds_alternative<NoLayer>(layer)) return read_rubber(section, contact);
  const auto* stiff = std::get_if<StiffLayer>(&layer);
  if (stiff == nullptr)
    section.refuse(
        "kind",
        "\"plane strain\" goes with the scaled layer, or none; accepted: model = \"scaled\"");
  return read_coating(section, contact, *stiff);
}

int most_cells(const MeshRequest& mesh) {
  const bool in_space = mesh.dimension == 3;
  if (mesh.kind == "structured") return in_space ? most_structured_in_space : most_structured;
  return in_space ? most_unstructured_in_space : most_unstructured;
}

/// The keys of a mesh of triangles.
void check_mesh_in_space(const Section& section) {
  for (const char* key : {"geometry", "refinements"})
    if (section.has(key))
      section.refuse(key, std::string("does not go with a mesh of tetrahedra; accepted: no ") +
                              key + ", or dimension = 2");
}

MeshRequest read_mesh(const Section& section, const std::filesystem::path& folder) {
  section.only_its_keys();
  const auto path_of = [&](const std::string& key) {
    const std::string path = section.text(key);
    if (path.empty() || path.find('\0') != path.npos)
      section.refuse(key, "is no path; accepted: " + section.row(key).accepted);
    return folder / path;
  };
  MeshRequest mesh;
  mesh.kind = section.one_of("kind");
  if (const char* other = mesh.from_file() ? "cells" : "file"; section.has(other))
    section.refuse(other,
                   fmt::format("does not go with kind = \"{}\"; accepted: {}", mesh.kind,
                               mesh.from_file() ? "file alone" : "with kind = \"file\" only"));
  if (mesh.from_file()) {
    mesh.file = path_of("file");
    mesh.dimension = named_dimension(mesh.file.string());
    if (section.has("dimension")) mesh.dimension = section.count("dimension");
    if (mesh.dimension == 3) check_mesh_in_space(section);
    if (section.has("geometry")) mesh.geometry = path_of("geometry");
  } else {
    if (section.has("geometry"))
      section.refuse("geometry", "goes with a mesh file only; accepted: with kind = \"file\"");
    if (section.has("dimension")) mesh.dimension = section.count("dimension");
    if (mesh.dimension == 3) check_mesh_in_space(section);
    mesh.cells = section.count("cells", most_cells(mesh));
  }
  if (!section.has("refinements")) return mesh;
  mesh.refinements = section.count("refinements");
  if (const int refined = mesh.cells << mesh.refinements; refined > most_structured)
    section.refuse(
        "refinements",
        fmt::format("{} refinements of {} cells per unit side make {}; accepted: up to {}",
                    mesh.refinements, mesh.cells, refined, most_structured));
  return mesh;
}

/// An accuracy and what goes with it: the mesh is found, with the active set.
void read_accuracy(const Section& section, MethodRequest& method) {
  for (const char* key : {"of", "most_unknowns"})
    if (section.has(key) && !section.has("accuracy"))
      section.refuse(
          key,
          "goes with an accuracy only; accepted: a key accuracy beside it, or none of the two");
  if (!section.has("accuracy")) return;
  method.accuracy = section.number("accuracy");
  if (section.one_of("of") == "stress") method.of = Quantity::stress;
  method.most_unknowns = section.number("most_unknowns");
  if (method.element != "CR" && method.of == Quantity::stress)
    section.refuse("of", "\"stress\" is proved of CR alone; accepted with element = \"" +
                             method.element + "\": \"displacement\"");
  if (method.solver != "active-set")
    section.refuse("solver",
                   "\"" + method.solver + "\" does not go with accuracy; accepted: \"active-set\"");
}

MethodRequest read_method(const Section& section) {
  section.only_its_keys();
  MethodRequest method;
  const bool accurate = section.has("accuracy");
  method.element = section.has("element") || !accurate ? section.one_of("element") : "CR";
  if (method.element == "M2") method.element = hybrid_bdm1().name();
  method.solver = section.one_of("solver");
  read_accuracy(section, method);
  method.tolerance = section.has("tolerance") || !accurate
                         ? section.number("tolerance")
                         : std::min(MethodRequest::roughest_tolerance, 1e-2 * *method.accuracy);
  return method;
}

/// Refuses the parts of a scene that are for the plane alone. They are read later, so that the
/// reason is not a formula of theirs.
void check_in_space(const Section& root) {
  const auto refuse = [&](const std::string& key, const std::string& what,
                          const std::string& accepted) {
    root.refuse(key, what + " does not go with a mesh of tetrahedra; accepted: " + accepted);
  };
  const Section model = root.section("model"), method = root.section("method");
  if (model.has("kind") && model.one_of("kind") != AntiPlaneModel::traits.name)
    refuse("model.kind", "\"plane strain\"", "\"anti-plane\"");
  if (const Section layer = root.section("layer"); layer.one_of("model") == "ventcel")
    refuse("layer.model", "\"ventcel\"", "\"scaled\", \"thin\"");
  if (is_between_bodies(root.section("contact")))
    refuse("contact", "the contact of two bodies", "a gap, a ceiling");
  for (const char* key : {"accuracy", "of", "most_unknowns"})
    if (method.has(key)) refuse(std::string("method.") + key, "an accuracy", "none");
  const std::string element = method.one_of("element"), solver = method.one_of("solver");
  const std::string quoted = "\"" + element + "\"";
  const bool contact = root.has("contact");
  if (element != "P1" && element != "P2" && element != "CR")
    refuse("method.element", quoted, contact ? "\"P1\", \"CR\"" : "\"P1\", \"P2\", \"CR\"");
  if (element == "P2" && contact)
    root.refuse("method.element",
                "\"P2\" on tetrahedra does not go with a contact, since its forces at vertices are "
                "no pressures; accepted: \"P1\", \"CR\"");
  if (solver == "petsc") refuse("method.solver", "\"petsc\"", "\"active-set\", \"uzawa\"");
}

/// What one section leaves out because of another.
void check_together(const Section& root, const Scene& scene, const MeshRequest& mesh,
                    const MethodRequest& method) {
  const bool ventcel = std::holds_alternative<VentcelLayer>(scene.layer());
  const bool petsc = method.solver == "petsc";
  if (mesh.kind == "layered" && !std::holds_alternative<StiffLayer>(scene.layer()))
    root.refuse("mesh.kind",
                "\"layered\" is the mesh of the scaled layer, which this scene does not have; "
                "accepted: a section [layer] with model = \"scaled\", or \"unstructured\"");
  // gmsh's edges in the layer are half as long as it is deep: at 0.02 it has 234,000 tetrahedra,
  // and four times as many at 0.01
  constexpr double thinnest_in_space = 0.02;
  const auto* thin = std::get_if<ThinLayer>(&scene.layer());
  if (thin != nullptr && mesh.dimension == 3 && mesh.kind == "unstructured" &&
      thin->epsilon < thinnest_in_space)
    root.refuse("layer.epsilon",
                fmt::format("{} is too thin for an unstructured mesh of tetrahedra; accepted: {} "
                            "or more, or kind = \"structured\"",
                            thin->epsilon, thinnest_in_space));
  if (method.accuracy && ventcel)
    root.refuse(
        "method.accuracy",
        "does not go with model = \"ventcel\"; accepted: model = \"scaled\" with epsilon = 0, "
        "which is the same problem");
  if (method.element != "P1" && method.element != "CR" && (petsc || ventcel))
    root.refuse("method.element",
                fmt::format("\"{}\" does not go with {}; accepted: \"P1\", \"CR\"", method.element,
                            petsc ? "solver = \"petsc\"" : "model = \"ventcel\""));
  if (petsc && !mesh.geometry.empty())
    root.refuse("mesh.geometry",
                "does not go with solver = \"petsc\"; accepted: \"active-set\", \"uzawa\"");
  if (!petsc && !method.accuracy) return;
  if (petsc) {
    const std::string beyond = root.has("at") ? "points" : scene.beyond_the_paper();
    if (!beyond.empty())
      root.refuse("method.solver",
                  "does not go with " + beyond + "; accepted: \"active-set\", \"uzawa\"");
    return;
  }
  if (const std::string beyond = scene.beyond_the_certificate(); !beyond.empty())
    root.refuse("method.accuracy",
                "does not go with " + beyond + "; accepted: a scene without it, or no accuracy");
}

void check_model(const Section&, const AntiPlaneModel&, const Scene&, const MethodRequest&) {}

void check_model(const Section& root, const TwoBodyModel&, const Scene& scene,
                 const MethodRequest& method) {
  const auto refuse = [&](const std::string& key, const std::string& what,
                          const std::string& accepted) {
    root.refuse(key, what + " does not go with two bodies; accepted: " + accepted);
  };
  if (method.accuracy) refuse("method.accuracy", "an accuracy", "none");
  if (method.element != "P1" && method.element != "CR")
    refuse("method.element", "\"" + method.element + "\"", "\"P1\", \"CR\"");
  if (std::holds_alternative<VentcelLayer>(scene.layer()))
    refuse("layer.model", "\"ventcel\"", "\"scaled\", \"thin\"");
}

/// What plane strain has no use for yet.
template <class Block>
void check_model(const Section& root, const PressedModel<Block>& model, const Scene& scene,
                 const MethodRequest& method) {
  const auto refuse = [&](const std::string& what, const std::string& accepted) {
    root.refuse("model.kind",
                "\"plane strain\" does not go with " + what + "; accepted: " + accepted);
  };
  if (method.accuracy || method.solver != "active-set")
    refuse("accuracy or another solver", "solver = \"active-set\"");
  if (method.element == hybrid_bdm1().name())
    refuse("element = \"" + method.element + "\", which has no Korn inequality",
           "\"CR\", \"P1\" to \"P4\"");
  if (scene.contact() && scene.contact()->upper_obstacle) refuse("a ceiling", "a gap alone");
  if (!scene.contact() && (scene.layer_depth() > 0 || model.block.friction))
    refuse("a layer or friction without contact", "a section [contact]");
  if (scene.body().stiffness)
    refuse("a stiffness of the body", "no [body]; with a [layer], young and poisson in [model]");
  const auto* layer = std::get_if<StiffLayer>(&scene.layer());
  if (layer != nullptr && layer->load) refuse("a load on the layer", "none");
  for (const BoundaryCondition& edge : scene.edges())
    if (edge.kind != BoundaryCondition::Kind::free &&
        edge.kind != BoundaryCondition::Kind::traction)
      refuse("a displacement or a spring on the group " + edge.group, "free = true, traction");
}

}  // namespace

bool has_contact(const SceneFile& file) {
  return file.scene.contact() || std::holds_alternative<TwoBodyModel>(file.model);
}

std::string beyond_the_paper(const SceneFile& file) {
  if (file.mesh.dimension == 3) return "three dimensions";
  return std::visit([&](const auto& model) { return model.beyond_the_paper(file.scene); },
                    file.model);
}

void require_paper_problem(const SceneFile& file, const std::string& who) {
  const std::string beyond = beyond_the_paper(file);
  if (!beyond.empty())
    throw InputError(fmt::format("{}: {}: does not know {}; accepted: a scene without it",
                                 file.name, who, beyond));
}

SceneFile read_scene_file(const std::filesystem::path& path) {
  return read_scene(read_text(path, printable(path.string(), 1000)), path);
}

SceneFile read_scene(const std::string& text, const std::filesystem::path& path) {
  const std::string name = printable(path.string(), 1000);
  const toml::table table = parse(text, name);
  const Section root(name, "", table, "");
  root.only_its_keys();
  for (const std::string& section : key_names(""))
    if (root.row(section).required && !root.has(section))
      root.refuse(section, fmt::format("is missing; accepted: a section [{}]", section));

  const std::string title = root.text("title");
  std::ostringstream words;
  words << toml::json_formatter{table};
  const MeshRequest mesh = read_mesh(root.section("mesh"), path.parent_path());
  const int dimension = mesh.dimension;
  if (dimension == 3) check_in_space(root);
  const bool unit_square = !mesh.from_file();  // what a file holds is known when it is read
  Body body = read_body(root, dimension);
  if (unit_square) sample_load(body.load, dimension);
  ExtraGroups groups;
  std::vector<BoundaryCondition> edges = read_edges(root.sections("edge"), groups, dimension);
  if (unit_square && !groups.curves.empty())
    root.refuse("edge", "names groups of a mesh file; accepted: with kind = \"file\" only");
  const Layer layer = root.has("layer") ? read_layer(root.section("layer"), dimension) : NoLayer{};
  std::optional<UnilateralContact> contact;
  std::optional<TwoBodyContact> between;
  if (root.has("contact") && is_between_bodies(root.section("contact")))
    between = read_interface(root.section("contact"), groups, edges);
  else if (root.has("contact"))
    contact = read_contact(root.section("contact"), dimension);
  if (between && unit_square)
    root.refuse("contact", "names groups of a mesh file; accepted: with kind = \"file\" only");
  read_groups(root.section("body"), mesh, groups, body);
  if (unit_square && !groups.bodies.empty())
    root.refuse("body", "names groups of a mesh file; accepted: with kind = \"file\" only");
  if (contact && unit_square) sample_profile(contact->gap, dimension);
  if (contact && contact->upper_obstacle && unit_square)
    sample_profile(contact->upper_obstacle, dimension);
  const SceneModel model = read_model(root.section("model"), contact, between, layer);
  const bool clamped_ends = unit_square && dimension == 2 && !traits_of(model).free_sides;
  if (contact && !clamped_ends) contact->zero_at.clear();  // check_on_mesh asks all held places
  const MethodRequest method = read_method(root.section("method"));
  const Scene scene = [&] {
    try {
      Scene made(body, layer, contact, edges);
      const auto ceiling_above_gap = [&](double x, double y) {
        check_upper_obstacle_at(*contact, x, y, dimension);
        return 0.0;
      };
      if (contact && unit_square) sample_profile(ceiling_above_gap, dimension);
      return made;
    } catch (const ObstacleError&
                 error) {  // what is left for the scene to refuse: what no clamped end can keep
      const bool ceiling = error.which == ObstacleError::Obstacle::ceiling;
      root.refuse(ceiling ? "contact.ceiling" : "contact.gap", error.what());
    }
  }();
  check_together(root, scene, mesh, method);
  std::visit([&](const auto& kind) { check_model(root, kind, scene, method); }, model);
  std::vector<Eigen::Vector3d> points;
  if (root.has("at")) points = read_points(root.section("at"), dimension);
  return {name, title, scene, mesh, method, words.str(), groups, points, model};
}

}  // namespace antilock
