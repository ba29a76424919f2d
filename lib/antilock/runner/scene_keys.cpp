#include "antilock/runner/scene_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "antilock/runner/scene_file.hpp"

namespace antilock {
namespace {

using Type = SceneKey::Type;

const std::string in_x_and_y = "an expression in x and y in quotes, as \"10*sin(2*pi*x)\"";
const std::string in_x = "an expression in x in quotes, as \"0.01\"";

std::string path_of(const std::string& what) {
  return "the path of " + what + ", relative to the scene file";
}

// clang-format off
std::vector<SceneKey> file_keys() {
  return {
      {.section = "", .name = "title", .type = Type::text, .does = "a name, printed and repeated in the summary",
       .otherwise = "", .accepted = "any text in quotes",
       .line = 1, .example = "\"figure 8\"", .comment = "optional"},
      {.section = "", .name = "load", .type = Type::section, .does = "the force on the body", .required = true,
       .line = 2, .comment = "required: the force per area on the body, -div(stiffness grad u) = f; u has one component, upwards"},
      {.section = "", .name = "body", .type = Type::section, .does = "the material of the body",
       .line = 5, .comment = "optional"},
      {.section = "", .name = "layer", .type = Type::section, .does = "the layer below the body",
       .line = 3, .comment = "leave out: no layer"},
      {.section = "", .name = "contact", .type = Type::section, .does = "the obstacle below",
       .line = 4, .comment = "leave out: no obstacle"},
      {.section = "", .name = "edge", .type = Type::sections, .does = "the condition on a group of curves of a mesh file",
       .line = 6, .comment = "one per group of curves of a mesh file beside clamped and contact"},
      {.section = "", .name = "at", .type = Type::section, .does = "places at which the summary has u",
       .line = 7, .comment = "optional: u there, in the summary"},
      {.section = "", .name = "model", .type = Type::section, .does = "the kind of problem",
       .line = 8, .comment = "optional"},
      {.section = "", .name = "mesh", .type = Type::section, .does = "the mesh", .required = true,
       .line = 9, .comment = "required"},
      {.section = "", .name = "method", .type = Type::section, .does = "how it is solved",
       .line = 10, .comment = "optional"},
  };
}

std::vector<SceneKey> body_keys() {
  return {
      {.section = "load", .name = "f", .type = Type::formula_xy, .does = "the force per area, upwards",
       .required = true, .accepted = in_x_and_y,
       .line = 1, .example = "\"10*sin(2*pi*x)\"",
       .comment = "in x and y: + - * / ^, sin cos exp sqrt abs, pi, comparisons, x < 0.5 ? 1 : 2\n"
                  "0.2 < x < 0.5 holds where both do; -x^2 is -(x^2), 2^3^2 is 2^9, 1/2 is 0.5, log is natural; a\n"
                  "comparison counts as 1 or 0, and stands on both sides of && and || and before ?"},
      {.section = "body", .name = "stiffness", .type = Type::formula_xy,
       .does = "the stiffness of the body, or a table with a number per group of surfaces of a mesh file",
       .required = true, .accepted = in_x_and_y + ", or a table per group",
       .line = 1, .example = "\"1 + 9*(x > 0.5)\"",
       .comment = "on each triangle as at its centroid; or per group of surfaces of a mesh file, which are\n"
                  "parts of the body: stiffness = { left = 1, right = 10 }"},
  };
}

std::vector<SceneKey> layer_keys() {
  return {
      {.section = "layer", .name = "epsilon", .type = Type::number,
       .does = "how thin and stiff the layer is; in its place thickness and stiffness",
       .accepted = "0 < epsilon <= 1, or exactly 0 (the rigid limit)",
       .line = 1, .example = "1e-6",
       .comment = "0 (the rigid limit) to 1\n"
                  "or the two numbers of a real layer, relative to a body of stiffness 1:\n"
                  "thickness = 0.01 and stiffness = 100 (s = 1 before a_x^-, s / thickness^2 before a_y^-)"},
      {.section = "layer", .name = "model", .type = Type::choice,
       .does = "problem (23) on a stretched layer, (22) on the true one, or the limit (25)",
       .otherwise = "scaled", .choices = {"scaled", "ventcel", "thin"},
       .line = 3, .example = "\"scaled\"",
       .comment = "\"scaled\" (default): problem (23) on (0,1) x (-1,0)\n"
                  "\"thin\": (22) on (0,1) x (-epsilon,0), epsilon from 1e-3\n"
                  "\"ventcel\": the limit (25) on Sigma, no layer mesh, epsilon = 0"},
      {.section = "layer", .name = "thickness", .type = Type::number,
       .does = "the thickness of the layer, in the unit of the mesh", .accepted = "0 < thickness <= 1"},
      {.section = "layer", .name = "stiffness", .type = Type::number, .does = "the stiffness of the layer",
       .accepted = "above 0, relative to a body of stiffness 1"},
      {.section = "layer", .name = "load", .type = Type::formula_xy,
       .does = "a force on the scaled layer as it is stretched", .accepted = in_x_and_y,
       .line = 2, .example = "\"0\"", .comment = "optional, scaled layer: a force on the layer as it is stretched"},
  };
}

std::vector<SceneKey> contact_keys() {
  return {
      {.section = "contact", .name = "gap", .type = Type::formula_x,
       .does = "how far the obstacle lies below: u >= -gap(x)", .otherwise = "0", .accepted = in_x,
       .line = 1, .example = "\"0\"", .comment = "how far the obstacle lies below: u >= -gap(x)"},
      {.section = "contact", .name = "ceiling", .type = Type::formula_x, .does = "an obstacle above: u <= ceiling(x)",
       .accepted = in_x,
       .line = 2, .example = "\"0.2\"",
       .comment = "optional: u <= ceiling(x) too; where it presses down, the pressure is negative"},
      {.section = "contact", .name = "slave", .type = Type::text,
       .does = "with two bodies: the group of the side whose unknowns have the constraints",
       .accepted = "the name of a group of curves of the mesh file",
       .line = 3, .example = "\"lower\"",
       .comment = "two bodies of a mesh file, which need not match: the groups of their sides on\n"
                  "one straight line, u above - u below >= -gap(x); the slave is the shorter\n"
                  "side, or the finer"},
      {.section = "contact", .name = "master", .type = Type::text,
       .does = "with two bodies: the group of the other side, at least as long",
       .accepted = "the name of a group of curves of the mesh file",
       .line = 4, .example = "\"upper\""},
      {.section = "contact", .name = "method", .type = Type::choice,
       .does = "with two bodies: means of the jump, or its values at the slave's unknowns",
       .otherwise = "mortar", .choices = {"mortar", "node to segment"},
       .line = 5, .example = "\"mortar\"",
       .comment = "with two bodies: \"mortar\" (default) or \"node to segment\""},
  };
}

std::vector<SceneKey> edge_keys() {
  return {
      {.section = "edge", .name = "group", .type = Type::text, .does = "the group, beside clamped and contact",
       .required = true, .accepted = "the name of a group of curves of the mesh file",
       .line = 1, .example = "\"top\"",
       .comment = "free = true, or one of: displacement = \"0.05\", traction = \"x\" (force per length), spring = \"2\" (-2 u)"},
      {.section = "edge", .name = "free", .type = Type::flag, .does = "no condition",
       .accepted = "true, or leave the key out",
       .line = 2, .example = "true"},
      {.section = "edge", .name = "displacement", .type = Type::formula_xy, .does = "u there", .accepted = in_x_and_y},
      {.section = "edge", .name = "traction", .type = Type::formula_xy, .does = "the force per length, upwards",
       .accepted = in_x_and_y},
      {.section = "edge", .name = "spring", .type = Type::formula_xy,
       .does = "the stiffness k >= 0 of a spring, whose force per length is -k u", .accepted = in_x_and_y},
  };
}

std::vector<SceneKey> point_and_model_keys() {
  return {
      {.section = "at", .name = "points", .type = Type::places, .does = "the places, in body and layer",
       .required = true, .accepted = "a list of places, as [[0.25, -1.0]]",
       .line = 1, .example = "[[0.25, -1.0]]"},
      {.section = "model", .name = "kind", .type = Type::choice,
       .does = "u of one component, or a block of rubber (without a layer) or with a coating, pressed down",
       .otherwise = "anti-plane", .choices = {"anti-plane", "plane strain"},
       .line = 1, .example = "\"plane strain\"",
       .comment = "a block pressed down on the gap: its clamped edges (of the unit square: the top) sink by\n"
                  "push = 0.1, the rest is free or has a traction upwards, f is upwards. Without a layer: rubber, mu = 1, epsilon = 1/lambda\n"
                  "(default 1e-8; 0: incompressible). With one: a coating of that thickness and of the block's\n"
                  "material (young = 1, poisson = 0.3) divided by it. friction = \"0.1\": Tresca's bound,\n"
                  "or coulomb = 0.3: Coulomb's coefficient, by a fixed point of Tresca's problems"},
      {.section = "model", .name = "push", .type = Type::number, .does = "how far the clamped edges sink",
       .otherwise = "0.1", .accepted = "-1e+06 to 1e+06", .range = SceneKey::Range{-1e6, 1e6},
       .models = {"rubber", "coating"}},
      {.section = "model", .name = "friction", .type = Type::formula_x, .does = "Tresca's bound, a force per length",
       .accepted = in_x, .models = {"rubber", "coating"}},
      {.section = "model", .name = "coulomb", .type = Type::number,
       .does = "the coefficient of Coulomb's friction: the tangential force is at most coulomb times the pressure",
       .accepted = "above 0, at most 10", .range = SceneKey::Range{.least = 0, .most = 10, .above = true},
       .models = {"rubber", "coating"}},
      {.section = "model", .name = "epsilon", .type = Type::number, .does = "1/lambda of the rubber, with mu = 1",
       .otherwise = "1e-8", .accepted = "0 to 1", .range = SceneKey::Range{0, 1}, .models = {"rubber"}},
      {.section = "model", .name = "young", .type = Type::number, .does = "Young's modulus of block and coating",
       .otherwise = "1", .accepted = "1e-06 to 1e+06", .range = SceneKey::Range{1e-6, 1e6}, .models = {"coating"}},
      {.section = "model", .name = "poisson", .type = Type::number, .does = "Poisson's ratio of block and coating",
       .otherwise = "0.3", .accepted = "0 to 0.49", .range = SceneKey::Range{0, 0.49}, .models = {"coating"}},
  };
}

std::vector<SceneKey> mesh_keys() {
  return {
      {.section = "mesh", .name = "kind", .type = Type::choice, .does = "a mesh that is made, or one from a file",
       .required = true, .choices = {"structured", "unstructured", "layered", "file"},
       .line = 1, .example = "\"unstructured\"",
       .comment = "\"structured\" (cells up to 2048), \"unstructured\" (up to 512), \"layered\" (up to 512: the\n"
                  "unstructured body over a scaled layer in columns) or \"file\""},
      {.section = "mesh", .name = "cells", .type = Type::count, .does = "cells per unit side: h = 1/cells",
       .accepted = "1 to 2048 (structured) or 512",
       .line = 2, .example = "64",
       .comment = "cells per unit side; with kind = \"file\" instead: file = \"my.msh\", beside the scene"},
      {.section = "mesh", .name = "file", .type = Type::path, .does = "the mesh, with kind = \"file\"",
       .accepted = path_of("a MSH file, 2.2 or 4.1")},
      {.section = "mesh", .name = "dimension", .type = Type::count,
       .does = "3: the body is the cube, its cells are tetrahedra; formulas are in x, y and z, "
               "a gap in x and y",
       .otherwise = "2", .accepted = "2 or 3", .range = SceneKey::Range{2, 3},
       .line = 3, .example = "2",
       .comment = "optional: 3 is the body (0,1)^3 of tetrahedra over the layer (0,1)^2 x (-1,0); z runs\n"
                  "across the layer, formulas are in x, y and z, gap and ceiling in x and y, [at] has\n"
                  "[[x, y, z]]; cells up to 128 (structured) or 64; elements \"P1\", \"CR\", \"P2\" (without\n"
                  "contact). A file that names a group of volumes is in space without this key"},
      {.section = "mesh", .name = "geometry", .type = Type::path,
       .does = "the geometry that the mesh file was made from: refinement returns to its curves",
       .accepted = path_of("a .geo or .brep file"),
       .line = 4, .example = "\"my.geo\"",
       .comment = "optional, with a file: the .geo or .brep that the mesh was made from, beside the scene"},
      {.section = "mesh", .name = "refinements", .type = Type::count,
       .does = "how often every triangle is cut into four", .otherwise = "0", .accepted = "1 to 10",
       .range = SceneKey::Range{1, 10},
       .line = 5, .example = "2",
       .comment = "optional: every triangle of that mesh is cut into four so many times; with \"petsc\" each\n"
                  "rank refines its own strip of a small mesh"},
  };
}

std::vector<SceneKey> method_keys() {
  const double most = MethodRequest::roughest_tolerance;
  return {
      {.section = "method", .name = "element", .type = Type::choice, .does = "the element; with an accuracy CR",
       .otherwise = "P1", .choices = {"P1", "CR", "P2", "P3", "P4", "BDM1-hybrid", "M2"},
       .line = 1, .example = "\"CR\"",
       .comment = "\"P1\" (default), \"CR\" (Crouzeix-Raviart), \"P2\", \"P3\", \"P4\" or \"BDM1-hybrid\", for short\n"
                  "\"M2\": locks on no mesh; its unknowns are weighted means of u, not values"},
      {.section = "method", .name = "solver", .type = Type::choice,
       .does = "this library's solver, the paper's, or PETSc",
       .otherwise = "active-set", .choices = {"active-set", "uzawa", "petsc"},
       .line = 2, .example = "\"active-set\"",
       .comment = "(default), \"uzawa\", the paper's, or \"petsc\": PETSc, alone or under mpiexec"},
      {.section = "method", .name = "tolerance", .type = Type::number,
       .does = "of the algebraic error, relative; with an accuracy a hundredth of it",
       .otherwise = "1e-10", .accepted = fmt::format("0 < tolerance <= {:g}", most),
       .range = SceneKey::Range{.least = 0, .most = most, .above = true},
       .line = 3, .example = "1e-10", .comment = "relative, on the algebraic error; at most 1e-3"},
      {.section = "method", .name = "accuracy", .type = Type::number,
       .does = "refine until the proved relative error in the energy norm is at most this",
       .accepted = "above 0 and below 1, as 1e-2",
       .range = SceneKey::Range{.least = 0, .most = 1, .above = true, .below = true},
       .line = 4, .example = "1e-2",
       .comment = "refine until the proved relative error in the energy norm is at most this: [mesh] is\n"
                  "the first mesh then, the element CR unless another is named, the solver active-set"},
      {.section = "method", .name = "of", .type = Type::choice, .does = "of which that error is",
       .otherwise = "displacement", .choices = {"displacement", "stress"},
       .line = 5, .example = "\"displacement\"",
       .comment = "with accuracy: of the displacement (default) or of the \"stress\""},
      {.section = "method", .name = "most_unknowns", .type = Type::number, .does = "with an accuracy: the limit",
       .otherwise = "2000000", .accepted = "a whole number of unknowns, 1 to 1e9",
       .range = SceneKey::Range{.least = 1, .most = 1e9, .whole = true},
       .line = 6, .example = "2000000", .comment = "with accuracy: the limit"},
  };
}
// clang-format on

/// The lines of a key in the help: its example, with the comment from column 32 on.
std::string help_lines(const SceneKey& key) {
  const bool section = key.type == Type::section;
  const std::string header =
      key.type == Type::sections ? "[[" + key.name + "]]" : "[" + key.name + "]";
  std::string start =
      section || key.type == Type::sections ? header : key.name + " = " + key.example;
  if (key.comment.empty()) return "  " + start + "\n";
  std::string lines;
  std::istringstream comment(key.comment);
  for (std::string line; std::getline(comment, line); start.clear())
    lines += fmt::format("{:<32}# {}\n", start.empty() ? "" : "  " + start, line);
  return lines;
}

/// The keys of a section that have a line in the help, by it.
std::vector<const SceneKey*> keys_in_help(const std::string& section) {
  std::vector<const SceneKey*> keys;
  for (const SceneKey& key : scene_keys())
    if (key.section == section && key.line > 0) keys.push_back(&key);
  std::sort(keys.begin(), keys.end(),
            [](const SceneKey* a, const SceneKey* b) { return a->line < b->line; });
  return keys;
}

}  // namespace

bool SceneKey::Range::holds(double value) const {
  if (whole && value != std::floor(value)) return false;
  const bool low = above ? value > least : value >= least;
  const bool high = below ? value < most : value <= most;
  return low && high;
}

const std::vector<SceneKey>& scene_keys() {
  static const std::vector<SceneKey> all = [] {
    std::vector<SceneKey> keys;
    for (const auto& part : {file_keys(), body_keys(), layer_keys(), contact_keys(), edge_keys(),
                             point_and_model_keys(), mesh_keys(), method_keys()})
      keys.insert(keys.end(), part.begin(), part.end());
    return keys;
  }();
  return all;
}

const SceneKey& scene_key(const std::string& section, const std::string& name) {
  for (const SceneKey& key : scene_keys())
    if (key.section == section && key.name == name) return key;
  throw std::logic_error("a scene file has no key " + section + "." + name);
}

std::vector<std::string> key_names(const std::string& section, const std::string& model) {
  std::vector<std::string> names;
  for (const SceneKey& key : scene_keys()) {
    const bool of_model =
        std::find(key.models.begin(), key.models.end(), model) != key.models.end();
    if (key.section == section && (key.models.empty() || of_model)) names.push_back(key.name);
  }
  return names;
}

std::string scene_keys_help() {
  std::string help;
  for (const SceneKey* key : keys_in_help("")) {
    help += help_lines(*key);
    if (key->type != Type::section && key->type != Type::sections) continue;
    for (const SceneKey* in_section : keys_in_help(key->name)) help += help_lines(*in_section);
  }
  return help;
}

}  // namespace antilock
