#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "antilock/certificate/certificate.hpp"
#include "antilock/mesh/read_msh.hpp"
#include "antilock/runner/scene_model.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// The mesh that a scene file requests.
struct MeshRequest {
  std::string kind;            ///< "structured", "unstructured", "layered" or "file"
  int cells = 0;               ///< cells per unit side; 0 with a file
  std::filesystem::path file;  ///< relative to the folder of the scene file, unless absolute
  /// How many times every triangle is then cut into four.
  int refinements = 0;
  /// With a mesh file: the .geo or .brep file whose curves the refined boundary follows.
  std::filesystem::path geometry = {};
  /// 2: triangles; 3: tetrahedra. Without the key it is that of the names in the mesh file.
  int dimension = 2;
  bool from_file() const { return kind == "file"; }
  CellKind cell_kind() const { return dimension == 3 ? CellKind::tetrahedron : CellKind::triangle; }
};

/// The section [method] of a scene file.
struct MethodRequest {
  /// The largest accepted tolerance. Above, the algebraic error would exceed discretisation errors.
  static constexpr double roughest_tolerance = 1e-3;
  /// The smallest tolerance that is reached. Below, double precision does not suffice.
  static constexpr double finest_tolerance = 1e-14;
  std::string element = "P1";         ///< "P1" to "P4", "CR" or "BDM1-hybrid"
  std::string solver = "active-set";  ///< "active-set", "uzawa" or "petsc"
  /// The relative tolerance of the algebraic error, 0 < tolerance <= roughest_tolerance.
  double tolerance = 1e-10;
  /// The relative error that is to be proved, in (0, 1). The element is then CR, unless P1 or P2 is
  /// named.
  std::optional<double> accuracy;
  /// The quantity whose error `accuracy` bounds.
  Quantity of = Quantity::displacement;
  /// The limit of the number of unknowns, with accuracy.
  double most_unknowns = 2e6;
};

/// The contents of a scene file in TOML (tutorials/scenes has examples, run_scene --help lists the
/// keys).
struct SceneFile {
  std::string name;  ///< the path as it was given; it is the beginning of every message
  std::string title;
  Scene scene;
  MeshRequest mesh;
  MethodRequest method;
  /// Its sections as JSON, which are copied into summary.json.
  std::string json;
  /// The groups of the mesh file that [[edge]] and a table of stiffnesses name.
  ExtraGroups groups = {};
  /// Points at which the summary gives u; z = 0 in the plane.
  std::vector<Eigen::Vector3d> at = {};
  SceneModel model = {};
};

/// Reads a scene file and checks everything that can be checked without a mesh. Throws Error, one
/// line `FILE: KEY: what is wrong; accepted: ...`. KEY is, for example, `layer.epsilon`. The
/// functions for the load and the gap throw the same Error later, where they are not finite.
SceneFile read_scene_file(const std::filesystem::path& path);

/// Reads a scene from a text in memory. `path` is its name in messages, and mesh files are searched
/// in its folder.
SceneFile read_scene(const std::string& text, const std::filesystem::path& path);

/// Returns whether the scene has a contact, on an obstacle or between two bodies.
bool has_contact(const SceneFile& file);

/// Returns the name of a feature that the problem of [SR04] (cited in
/// problem/variational_inequality.hpp) does not have: three dimensions, plane strain, or the one
/// of Scene::beyond_the_paper. The text is empty if the scene has no such feature.
std::string beyond_the_paper(const SceneFile& file);

/// Throws Error, `FILE: WHO: ...`, for a scene with such a feature.
void require_paper_problem(const SceneFile& file, const std::string& who);

}  // namespace antilock
