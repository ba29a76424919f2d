#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "antilock/adapt/marking.hpp"
#include "antilock/certificate/certificate.hpp"
#include "antilock/core/progress.hpp"
#include "antilock/measure/result.hpp"
#include "antilock/scene/scene.hpp"
#include "antilock/solve/solution.hpp"

namespace antilock {

/// The goal of adaptive refinement: a guaranteed relative error in the energy norm of at most
/// `relative`.
struct AccuracyGoal {
  double relative;  ///< in (0, 1)
  /// The quantity whose error is bounded. The midpoint of the two fluxes (Quantity::stress) needs a
  /// quarter of the unknowns that the displacement needs.
  Quantity of = Quantity::displacement;
  double most_unknowns = 2e6;  ///< of Crouzeix-Raviart on the last mesh
  /// Empty: extrude for epsilon <= 0.1 (with P1 and P2 only where the first mesh has columns), else
  /// bisect.
  std::optional<RefinementStrategy> strategy = {};
  /// An upper limit for the relative algebraic error of a solve. The certificate may need less.
  double tolerance = 1;
  const Element* element = &crouzeix_raviart();  ///< or P1, P2, only for the displacement
  /// Called between the steps of a level and in its solves. If it returns false, the refinement
  /// stops.
  ProgressHook follow = {};
};

/// One level of the refinement.
struct RefinementLevel {
  int unknowns = 0;
  double bound = 0, relative = 0;  ///< guaranteed, absolute and relative
  double seconds = 0;              ///< wall seconds since the start
  /// Predictions for the goal, from the third level on; 0 before.
  double predicted_unknowns = 0, predicted_seconds = 0;
};

/// The solution of the last level and its certificate.
struct CertifiedSolution {
  /// The solution with the requested element on the last mesh, with the locking report. Its warning
  /// contains that of the report, and names a part of the load that the sampling of the certificate
  /// may miss.
  Result result;
  /// The displacement that is certified: u at the vertices, p per layer triangle. Where the layer
  /// is bisected at small epsilon, this displacement has columns of its own in the layer. Then u is
  /// its interpolant and p is empty.
  Solution companion;
  Certificate certificate;
  std::vector<RefinementLevel> history;
};

/// Refines adaptively until the certificate guarantees the accuracy. Each solve goes on until its
/// algebraic residual is at most a tenth of the constitutive error (Certificate). `first` is the
/// first mesh, of any body. Where the layer is extruded, a mesh of only the body suffices. The
/// Ventcel layer is solved as the scaled one with epsilon = 0. Refined triangles have the shapes of
/// those of the first mesh. Therefore more unknowns are needed than on a fine mesh of gmsh: 6 %
/// more if the first mesh is gmsh's mesh with 1/h = 8, and 1 % more if it is the one with 1/h = 16.
/// `progress` is called after every level.
///
/// A P1 result is the conforming companion itself, because it is in K also between the vertices.
/// The flux comes from a Crouzeix-Raviart solution on the same mesh. The bound of a P2 result is
/// the bound of the P1 companion plus the distance between both (certified_distance). Where P1 or
/// P2 locks, h must fall to about epsilon before the error does. Where a prediction exceeds the
/// limit of unknowns, refinement ends at once, and the message names the reason.
///
/// Throws Error for an accuracy outside (0, 1), another element, a limit below the unknowns of the
/// first mesh, and a scene and a mesh that do not fit. Throws NotConverged, with the accuracy that
/// can be reached, where the goal is beyond the limit, and Interrupted where accuracy.follow
/// returns false.
CertifiedSolution solve_to(const Scene& scene, const TriangleMesh& first,
                           const AccuracyGoal& accuracy,
                           const std::function<void(const RefinementLevel&)>& progress = {});

}  // namespace antilock
