#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "antilock/analysis/certificate.hpp"
#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// The mesh that a scene file asks for.
struct MeshRequest {
  enum class Kind { structured, unstructured, layered, file };
  Kind kind = Kind::structured;
  int cells = 0;               ///< cells per unit side; 0 where kind is file
  std::filesystem::path file;  ///< where kind is file: beside the scene file, unless absolute
  int refinements = 0;         ///< how often every triangle is then cut into four
};

/// How a scene file wants to be solved.
struct MethodRequest {
  static constexpr double roughest_tolerance = 1e-3;  ///< beyond, the answer says less than any mesh does
  static constexpr double finest_tolerance = 1e-14;   ///< below, no double can be promised
  std::string element = "P1";                         ///< "P1", "CR" or "P2"
  std::string solver = "active-set";                  ///< "active-set", "uzawa" or "petsc"
  double tolerance = 1e-10;        ///< relative, on the algebraic error; 0 < tolerance <= roughest_tolerance
  std::optional<double> accuracy;  ///< proved relative error asked for, in (0, 1); the element is CR then
  Quantity of = Quantity::displacement;
  double most_unknowns = 2e6;  ///< with accuracy: the limit
};

/// The words of the file, for the summary, which repeats the question; empty where the section is absent.
struct SceneWords {
  std::string load, gap, model, mesh, file;
};

/// A question asked in TOML, sections load, layer, contact, mesh, method (tutorials/scenes holds examples).
struct SceneFile {
  std::string name;  ///< the path as it was given: every message starts with it
  std::string title;
  Scene scene;
  MeshRequest mesh;
  MethodRequest method;
  SceneWords words;
};

/// Reads and checks everything that can be checked without a mesh. Throws Error, one line `FILE: KEY: what is wrong;
/// accepted: ...`, KEY as in `layer.epsilon`. The load and the gap of the scene throw the same way, wherever they turn
/// out not to be finite later.
SceneFile read_scene_file(const std::filesystem::path& path);

/// The same from a text in memory; `path` is its name in messages, and mesh files are looked for beside it.
SceneFile read_scene(const std::string& text, const std::filesystem::path& path);

/// The mesh of a scene file: made, or read and compared with the scene, then refined. From a file the body may be anything on or above
/// y = 0 with a bottom edge on that line: with a layer all of it is Sigma, and the layer fills the strip below, contact
/// at its bottom; without one all of it is contact. Throws Error as above, KEY mesh.cells, mesh.file or mesh.refinements,
/// or load.f and contact.gap where these have no value on the body of a file.
TriangleMesh make_mesh(const SceneFile& file);

/// The mesh width to report: 1/cells of the refined mesh, or the longest edge of a mesh from a file and of one refined to an accuracy.
double mesh_width(const SceneFile& file, const TriangleMesh& mesh);

}  // namespace antilock
