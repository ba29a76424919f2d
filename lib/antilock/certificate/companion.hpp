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

/// A conforming function v of K, P1 in the body on the mesh of the Crouzeix-Raviart solution that it accompanies.
struct ConformingCompanion {
  Eigen::VectorXd at_vertices;              ///< V values; those of the layer's vertices only without `columns`
  Eigen::VectorXd stress;                   ///< epsilon^-2 d_y v per layer triangle (scaled layer, without `columns`)
  std::optional<ExtrudedP1Function> layer;  ///< v in the layer where that has columns of its own
  int unknowns = 0;                         ///< solved for

  /// A grad v on triangle t of the mesh, `row` of its layer's, under its law.
  Eigen::Vector2d flux(const TriangleMesh& mesh, int t, int row, const FluxLaw& law) const;
};

/// Bounds for the contact unknowns of a P1 space under which v >= -gap on the whole of Gamma_C, not at the vertices
/// alone. Per edge the one of two that is nearer to v: -gap at the ends, raised by what its chord leaves out, which is
/// right where the gap is smooth; or the largest -gap at both ends, which is right where it has a step or a kink. The gap
/// is sampled at 33 points per edge. `near`: V values, v at the held ends, and near it elsewhere.
Eigen::VectorXd admissible_bounds(const UnilateralContact& contact, const Space& space, const Eigen::VectorXd& near);

/// The problem of a scene whose K_h is part of K, by admissible_bounds. The space is P1.
VariationalInequality assemble_in_k(const Scene& scene, const Space& space);

/// The strip: v is the average of u_CR, weighted by the stiffness, at the body's vertices off Sigma, and on Sigma and in the layer the function of
/// least energy in K, by active set. The scaled layer has columns for it under the vertices of Sigma (mesh/layered.hpp),
/// the mesh's own where it is extruded already: P1 cannot lock on them. A handful of unknowns per column, whatever the
/// body has. Throws what active_set throws.
/// `on_mesh`: no columns of its own, P1 on the layer's triangles as they are, which lock unless epsilon is large.
ConformingCompanion local_companion(const Scene& scene, const Result& result, bool on_mesh = false);

/// A P1 solution on the mesh itself as the companion.
ConformingCompanion p1_companion(const Solution& p1_solution);

}  // namespace antilock
