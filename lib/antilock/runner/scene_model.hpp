#pragma once
// The kinds of problem that [model] of a scene file names.
#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "antilock/analysis/solve.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/models/plane_strain.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

struct SceneFile;

/// The properties of a kind of model that the mesh and the checks depend on.
struct ModelTraits {
  const char* name;     ///< [model] kind
  int components;       ///< of u; an unknown of the space has as many values
  bool free_sides;      ///< the sides x = 0 and x = 1 of the unit square are free, not clamped
  bool curved_contact;  ///< the contact edges of a mesh file may leave the line y = 0
};

/// u has one component, upwards: the scene itself is the model (models/anti_plane.hpp).
///
/// Every kind of model has the members of this one. The rest of runner/ and the programs know no more of a model, so that
/// a new one is a type in SceneModel, its members, and its keys where scene files are read.
struct AntiPlaneModel {
  static constexpr ModelTraits traits{"anti-plane", 1, false, true};

  /// What goes beyond the paper's problem, in words; empty where nothing does.
  std::string beyond_the_paper(const Scene& scene) const { return scene.beyond_the_paper(); }
  /// V values: the displacement (of two components the second) that Dirichlet edges have at the vertices; meaningless at
  /// all others.
  Eigen::VectorXd dirichlet_values(const Scene& scene, const TriangleMesh& mesh) const;
  /// The discrete problem on a space of its mesh, of two components in this space: u_x, then u_y. Throws Error.
  VariationalInequality problem(const Scene& scene, const Space& space) const;
  /// ActiveSetOptions::penalty.
  std::optional<double> penalty(const Space& space) const;
  /// The solution by a solver, with a report on its locking where anything could make it lock (analysis/solve.hpp).
  Result solve(const SceneFile& file, const Space& space, const Solver& solver) const;
  /// The tangential force per length at the contact unknowns, in their order; empty without friction.
  std::optional<Eigen::VectorXd> friction_forces(const Result& result) const;
  /// solution.vtu, `pressure` that of the contact unknowns, empty without contact.
  void write_picture(const std::filesystem::path& path, const Result& result, const Eigen::VectorXd& pressure) const;
  /// The subcommand of `render` that draws it.
  const char* picture(bool mesh_from_file) const { return mesh_from_file ? "plan" : "surface"; }
};

/// [model] kind = "plane strain": a block that is pressed down. `block` holds all of [model], [contact] and [layer].
template <class Block>
struct PressedModel {
  static constexpr ModelTraits traits{"plane strain", 2, true, false};
  Block block;

  std::string beyond_the_paper(const Scene&) const { return traits.name; }
  Eigen::VectorXd dirichlet_values(const Scene& scene, const TriangleMesh& mesh) const;
  VariationalInequality problem(const Scene& scene, const Space& space) const;
  std::optional<Eigen::VectorXd> friction_forces(const Result& result) const;
  const char* picture(bool) const { return "deformed"; }
};

/// Without a layer: rubber (models/plane_strain.hpp).
struct RubberModel : PressedModel<PlaneStrain> {
  std::optional<double> penalty(const Space& space) const;
  Result solve(const SceneFile& file, const Space& space, const Solver& solver) const;
  /// P1 locks where h^2 is not small beside epsilon. Nothing is proved of it.
  std::optional<LockingReport> locking_report(const SceneFile& file, const Space& space) const;
  /// T values: -lambda div u.
  Eigen::VectorXd pressure(const Result& result) const;
  void write_picture(const std::filesystem::path& path, const Result& result, const Eigen::VectorXd& pressure) const;
};

/// With the scaled layer: a coating of its thickness (models/coating.hpp).
struct CoatingModel : PressedModel<Coating> {
  std::optional<double> penalty(const Space& space) const;
  Result solve(const SceneFile& file, const Space& space, const Solver& solver) const;
  /// Conforming elements lock off columns where the length k by which they resist bending is not small beside the
  /// thickness (analysis/locking.hpp). Nothing is proved of it.
  std::optional<LockingReport> locking_report(const SceneFile& file, const Space& space) const;
  /// T values: minus the stress in y.
  Eigen::VectorXd pressure(const Result& result) const;
  void write_picture(const std::filesystem::path& path, const Result& result, const Eigen::VectorXd& pressure) const;
};

using SceneModel = std::variant<AntiPlaneModel, RubberModel, CoatingModel>;

inline const ModelTraits& traits_of(const SceneModel& model) {
  return std::visit([](const auto& kind) -> const ModelTraits& { return kind.traits; }, model);
}

}  // namespace antilock
