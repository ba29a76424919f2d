#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "antilock/certificate/certificate.hpp"
#include "antilock/mesh/read_msh.hpp"
#include "antilock/runner/scene_model.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// The mesh that a scene file asks for.
struct MeshRequest {
  std::string kind;                     ///< "structured", "unstructured", "layered" or "file"
  int cells = 0;                        ///< cells per unit side; 0 with a file
  std::filesystem::path file;           ///< beside the scene file, unless absolute
  int refinements = 0;                  ///< how often every triangle is then cut into four
  std::filesystem::path geometry = {};  ///< of a mesh file: the .geo or .brep file to whose curves refinement returns
  bool from_file() const { return kind == "file"; }
};

/// How a scene file wants to be solved.
struct MethodRequest {
  static constexpr double roughest_tolerance = 1e-3;  ///< beyond, the answer says less than any mesh does
  static constexpr double finest_tolerance = 1e-14;   ///< below, no double can be promised
  std::string element = "P1";                         ///< "P1" to "P4" or "CR"
  std::string solver = "active-set";                  ///< "active-set", "uzawa" or "petsc"
  double tolerance = 1e-10;  ///< relative, on the algebraic error; 0 < tolerance <= roughest_tolerance
  std::optional<double>
      accuracy;  ///< proved relative error asked for, in (0, 1); the element is CR unless P1 or P2 is named
  Quantity of = Quantity::displacement;
  double most_unknowns = 2e6;  ///< with accuracy: the limit
};

/// A question asked in TOML (tutorials/scenes holds examples, run_scene --help lists the keys).
struct SceneFile {
  std::string name;  ///< the path as it was given: every message starts with it
  std::string title;
  Scene scene;
  MeshRequest mesh;
  MethodRequest method;
  std::string json;                      ///< its sections as JSON, for the summary, which repeats the question
  ExtraGroups groups = {};               ///< of the mesh file: those that [[edge]] and a table of stiffnesses name
  std::vector<Eigen::Vector2d> at = {};  ///< where the summary tells u
  SceneModel model = {};
};

/// Reads and checks everything that can be checked without a mesh. Throws Error, one line `FILE: KEY: what is wrong;
/// accepted: ...`, KEY as in `layer.epsilon`. The load and the gap of the scene throw the same way, wherever they turn
/// out not to be finite later.
SceneFile read_scene_file(const std::filesystem::path& path);

/// The same from a text in memory; `path` is its name in messages, and mesh files are looked for beside it.
SceneFile read_scene(const std::string& text, const std::filesystem::path& path);

/// What goes beyond the paper's problem, in words: plane strain, or what Scene::beyond_the_paper names; empty where
/// nothing does.
std::string beyond_the_paper(const SceneFile& file);

/// Throws Error, `FILE: WHO: ...`, for a scene that goes beyond the paper's problem.
void require_paper_problem(const SceneFile& file, const std::string& who);

}  // namespace antilock
