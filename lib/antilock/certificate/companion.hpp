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

/// A conforming function v of K, the companion of a Crouzeix-Raviart solution: P1 in the body on
/// the same mesh, and in the layer P1 on the same mesh or on columns of its own (layer).
struct ConformingCompanion {
  /// V values of v; with `layer` those of the body alone are valid.
  Eigen::VectorXd at_vertices;
  /// epsilon^-2 d_y v per triangle of a scaled layer; empty with `layer`.
  Eigen::VectorXd stress;
  std::optional<ExtrudedP1Function> layer;  ///< v in the layer, where that has columns of its own
  int unknowns = 0;                         ///< of the local problem that was solved

  /// Returns A grad v on triangle t of the mesh, under its law. `row` is its number among the
  /// triangles of the layer.
  Eigen::Vector2d flux(const TriangleMesh& mesh, int t, int row, const FluxLaw& law) const;
};

/// Returns lower bounds (one per contact unknown of a P1 space) under which v >= -gap on all of
/// Gamma_C, the contact boundary, and not at the vertices alone. On each edge it takes the one of
/// two choices that lifts v less: -gap at the ends, raised by the largest amount by which -gap
/// exceeds its chord, which suits a smooth gap; or the largest -gap of the edge at both ends, which
/// suits a step or a kink. The gap is sampled at 33 points per edge. `near` (V values) is v at the
/// prescribed ends, and near v elsewhere. Throws Error where the gap is not finite.
Eigen::VectorXd admissible_bounds(const UnilateralContact& contact, const Space& space, const Eigen::VectorXd& near);

/// Assembles the problem of a scene on a P1 space with the bounds of admissible_bounds, so that K_h
/// is part of K.
VariationalInequality assemble_in_k(const Scene& scene, const Space& space);

/// Returns a conforming reconstruction by a local solve in the layer. At the body's vertices off
/// Sigma, the interface of body and layer, v is the average of u_CR, weighted by the stiffness. On
/// Sigma and in the layer it minimises the energy in K, by active set. The scaled layer has columns
/// for it under the vertices of Sigma (mesh/layered.hpp), or the mesh's own ones where it is
/// extruded already: P1 does not lock on columns. The local problem has a handful of unknowns per
/// column, whatever the size of the body. With `on_mesh` the layer has no columns of its own: v is
/// P1 on its triangles as they are, which lock unless epsilon is large. Throws what active_set
/// throws.
ConformingCompanion local_companion(const Scene& scene, const Result& result, bool on_mesh = false);

/// Returns a P1 solution on the mesh itself as the companion.
ConformingCompanion p1_companion(const Solution& p1_solution);

}  // namespace antilock
