#pragma once
#include <filesystem>
#include <string>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// The mesh that a scene file asks for.
struct MeshRequest {
  enum class Kind { structured, unstructured, file };
  Kind kind = Kind::structured;
  int cells = 0;               ///< cells a unit side; 0 where kind is file
  std::filesystem::path file;  ///< where kind is file: beside the scene file, unless absolute
};

/// How a scene file wants to be solved.
struct Method {
  std::string element = "P1";         ///< "P1" or "CR"
  std::string solver = "active-set";  ///< "active-set", "uzawa" or "petsc"
  double tolerance = 1e-10;           ///< relative, on the algebraic error; 0 < tolerance < 1
};

/// A question asked in TOML, sections load, layer, contact, mesh, method (tutorials/scenes holds examples).
struct SceneFile {
  std::string name;  ///< the path as it was given: every message starts with it
  std::string title;
  Scene scene;
  MeshRequest mesh;
  Method method;
};

/// Reads and checks everything that can be checked without a mesh. Throws Error, one line `FILE: KEY: what is wrong;
/// accepted: ...`, KEY as in `layer.epsilon`. The load and the gap of the scene throw the same way, wherever they turn
/// out not to be finite later.
SceneFile read_scene_file(const std::filesystem::path& path);

/// The same from a text in memory; `path` is its name in messages, and mesh files are looked for beside it.
SceneFile read_scene(const std::string& text, const std::filesystem::path& path);

/// The mesh of a scene file: made, or read and compared with the scene: the body must cover (0,1) x (0,1) and the layer
/// the rectangle of its model, with contact edges on their lower side. Throws Error as above, KEY mesh.cells or
/// mesh.file.
TriangleMesh make_mesh(const SceneFile& file);

/// The mesh width to report: 1/cells, or the longest edge of a mesh from a file.
double mesh_width(const SceneFile& file, const TriangleMesh& mesh);

}  // namespace antilock
