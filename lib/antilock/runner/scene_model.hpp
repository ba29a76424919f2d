#pragma once
// The kinds of problem that [model] of a scene file names.
#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "antilock/analysis/solve.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/models/coating.hpp"
#include "antilock/models/plane_strain.hpp"
#include "antilock/models/two_bodies.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

struct SceneFile;

/// The properties of a kind of model on which the mesh and the checks depend.
struct ModelTraits {
  const char* name;     ///< [model] kind
  int components;       ///< of u; an unknown of the space has so many values
  bool free_sides;      ///< the sides x = 0 and x = 1 of the unit square are free, not clamped
  bool curved_contact;  ///< the contact edges of a mesh file may leave the line y = 0
};

/// The scene itself is the model (models/anti_plane.hpp). u has one component, upwards.
///
/// Every kind of model has the members of this one. The rest of runner/ and the programs use only
/// these members. So a new model is a type in SceneModel with these members, and its keys in the
/// reader of scene files.
struct AntiPlaneModel {
  static constexpr ModelTraits traits{"anti-plane", 1, false, true};

  /// Returns the name of a feature that the problem of [SR04] (cited in
  /// problem/variational_inequality.hpp) does not have; empty if there is none.
  std::string beyond_the_paper(const Scene& scene) const { return scene.beyond_the_paper(); }
  /// Returns V values: the displacement prescribed at the vertices of Dirichlet edges, its second
  /// component in plane strain. Other vertices have no meaningful value.
  Eigen::VectorXd dirichlet_values(const Scene& scene, const TriangleMesh& mesh) const;
  /// Returns the discrete problem on a space of its mesh. In plane strain both components are in
  /// this space: first u_x, then u_y. Throws Error.
  VariationalInequality problem(const Scene& scene, const Space& space) const;
  /// Returns the value of ActiveSetOptions::penalty for this problem.
  std::optional<double> penalty(const Space& space) const;
  /// Returns the solution by a solver, with a report on its locking where the element can lock
  /// (analysis/solve.hpp).
  Result solve(const SceneFile& file, const Space& space, const Solver& solver) const;
  /// Returns the tangential force per length at the contact unknowns, in their order; empty without
  /// friction.
  std::optional<Eigen::VectorXd> friction_forces(const Result& result) const;
  /// Writes solution.vtu. `pressure` has one value per contact unknown, and is empty without
  /// contact.
  void write_picture(const std::filesystem::path& path, const Result& result,
                     const Eigen::VectorXd& pressure) const;
  /// Returns the subcommand of `render` that draws the solution in the plane.
  const char* picture(bool mesh_from_file) const { return mesh_from_file ? "plan" : "surface"; }
};

/// The anti-plane model with the contact of two bodies (models/two_bodies.hpp). Its scene has no
/// contact of its own.
struct TwoBodyModel : AntiPlaneModel {
  TwoBodyContact between;

  explicit TwoBodyModel(TwoBodyContact contact) : between(std::move(contact)) {}
  std::string beyond_the_paper(const Scene&) const { return "two bodies"; }
  VariationalInequality problem(const Scene& scene, const Space& space) const;
  /// The report on locking compares energies, where the element can lock. J is that of u_h, J_CR
  /// that of Crouzeix-Raviart on the same mesh, and J_0 that of the same element with u = 0 in the
  /// layer. The estimate of the lost share is (J - J_CR) / (J_0 - J_CR). It is not proved. It
  /// contains the discretisation errors of both elements, and so there is a warning from 25 % on.
  Result solve(const SceneFile& file, const Space& space, const Solver& solver) const;
  /// From above both sides of the interface would be one line.
  const char* picture(bool) const { return "surface"; }
};

/// The model of [model] kind = "plane strain": a block that is pressed down. `block` holds all of
/// [model], [contact] and [layer], except for the coefficient of Coulomb's friction.
template <class Block>
struct PressedModel {
  static constexpr ModelTraits traits{"plane strain", 2, true, false};
  Block block;
  /// The coefficient of Coulomb's friction; 0: none. With it the limits `block.friction` are 0, and
  /// `solve` replaces them (solve/coulomb_friction.hpp).
  double coulomb = 0;

  std::string beyond_the_paper(const Scene&) const { return traits.name; }
  Eigen::VectorXd dirichlet_values(const Scene& scene, const TriangleMesh& mesh) const;
  VariationalInequality problem(const Scene& scene, const Space& space) const;
  std::optional<double> penalty(const Space& space) const;
  Result solve(const SceneFile& file, const Space& space, const Solver& solver) const;
  /// Returns the report on locking of this element on this mesh; empty if there is nothing to
  /// report. Its criteria are not proved.
  std::optional<LockingReport> locking_report(const SceneFile& file, const Space& space) const;
  std::optional<Eigen::VectorXd> friction_forces(const Result& result) const;
  /// Returns T values, one per triangle: the pressure in the block.
  Eigen::VectorXd pressure(const Result& result) const;
  void write_picture(const std::filesystem::path& path, const Result& result,
                     const Eigen::VectorXd& pressure) const;
  const char* picture(bool) const { return "deformed"; }
};

/// The model without a layer: rubber (models/plane_strain.hpp).
using RubberModel = PressedModel<PlaneStrain>;
template <>
std::optional<double> PressedModel<PlaneStrain>::penalty(const Space& space) const;
/// Reports that P1 locks if h^2 is not small compared with epsilon, h relative to the size of the
/// body.
template <>
std::optional<LockingReport> PressedModel<PlaneStrain>::locking_report(const SceneFile& file,
                                                                       const Space& space) const;
/// Returns -lambda div u.
template <>
Eigen::VectorXd PressedModel<PlaneStrain>::pressure(const Result& result) const;

/// The model with the scaled layer: a coating of its thickness (models/coating.hpp).
using CoatingModel = PressedModel<Coating>;
template <>
std::optional<double> PressedModel<Coating>::penalty(const Space& space) const;
/// Reports locking for a conforming element on a layer without columns if the bending length k of
/// the mesh is not small compared with the thickness (analysis/locking.hpp).
template <>
std::optional<LockingReport> PressedModel<Coating>::locking_report(const SceneFile& file,
                                                                   const Space& space) const;
/// Returns minus the stress in y.
template <>
Eigen::VectorXd PressedModel<Coating>::pressure(const Result& result) const;

using SceneModel = std::variant<AntiPlaneModel, TwoBodyModel, RubberModel, CoatingModel>;

inline const ModelTraits& traits_of(const SceneModel& model) {
  return std::visit([](const auto& kind) -> const ModelTraits& { return kind.traits; }, model);
}

}  // namespace antilock
