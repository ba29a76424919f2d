#pragma once
#include <optional>

#include "antilock/certificate/detail/extruded_p1_function.hpp"
#include "antilock/certificate/equilibrated_flux.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/problem/variational_inequality.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/solution.hpp"
#include "antilock/space/space.hpp"

namespace antilock {

/// A conforming function v of K, the admissible set of the exact problem. It is the companion of a
/// Crouzeix-Raviart solution. In the body v is P1 on the same mesh. In the layer v is P1 on the
/// same mesh, or on a mesh of columns (`layer`).
struct ConformingCompanion {
  /// V values of v; with `layer` only those in the body are valid.
  Eigen::VectorXd at_vertices;
  /// epsilon^-2 d_y v per triangle of a scaled layer; empty with `layer`.
  Eigen::VectorXd stress;
  std::optional<ExtrudedP1Function> layer;  ///< v in the layer, if it has columns of its own
  /// The number of unknowns of the local problem that was solved.
  int unknowns = 0;

  /// Returns A grad v on triangle t of the mesh, with the A of `law`. `row` is the number of t
  /// among the triangles of the layer.
  Eigen::Vector2d flux(const TriangleMesh& mesh, int t, int row, const FluxLaw& law) const;
};

/// Returns lower bounds (one per contact unknown of a P1 space) under which v >= -gap on all of
/// Gamma_C, the contact boundary, and not only at the vertices. There are two choices per edge. The
/// first is -gap at the ends, raised by the largest amount by which -gap exceeds its chord; it
/// suits a smooth gap. The second is the largest -gap of the edge at both ends; it suits a step or
/// a kink. The choice that lifts v less is taken. Where v is prescribed at one end, the bound of
/// the other end alone keeps v above -gap. The gap is sampled at 33 points per edge. `near` (V
/// values) equals v at prescribed vertices, and approximates v elsewhere. Throws Error where the
/// gap is not finite.
Eigen::VectorXd admissible_bounds(const UnilateralContact& contact, const Space& space,
                                  const Eigen::VectorXd& near);

/// Assembles the problem of a scene on a P1 space with the bounds of admissible_bounds, so that the
/// discrete admissible set K_h is a subset of K.
VariationalInequality assemble_in_k(const Scene& scene, const Space& space);

/// Returns a conforming reconstruction by a local solve in the layer. At the body's vertices off
/// Sigma, the interface of body and layer, v is the average of u_CR, weighted by the stiffness. On
/// Sigma and in the layer it minimises the energy in K, by active set. For v the scaled layer is
/// cut into columns below the edges of Sigma (mesh/layered.hpp), because P1 does not lock on
/// columns. If the mesh is extruded already, these are its own columns. The local problem has a
/// handful of unknowns per column, whatever the size of the body. With `on_mesh` v is P1 on the
/// layer's triangles of the mesh instead, and locks unless epsilon is large. Throws as active_set
/// does.
ConformingCompanion local_companion(const Scene& scene, const Result& result, bool on_mesh = false);

/// Returns a P1 solution on the mesh itself as the companion.
ConformingCompanion p1_companion(const Solution& p1_solution);

}  // namespace antilock
