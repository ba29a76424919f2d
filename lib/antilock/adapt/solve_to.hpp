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

/// What is asked: the proved relative error in the energy norm is at most `relative`.
struct AccuracyGoal {
  double relative;  ///< in (0, 1)
  Quantity of =
      Quantity::displacement;  ///< or the stress field in the middle of the two fluxes: a quarter of the unknowns
  double most_unknowns = 2e6;  ///< of Crouzeix-Raviart, on the last mesh
  std::optional<RefinementStrategy> strategy =
      {};                ///< empty: columns for epsilon <= 0.1 (P1, P2: where the first mesh has them), else
                         ///< everything is bisected
  double tolerance = 1;  ///< relative, on the algebraic error; no less than the certificate needs
  const Element* element = &crouzeix_raviart();  ///< or P1, P2, on the mesh as it is: displacement alone
  ProgressHook follow = {};  ///< called between the steps of each level, and in its solves; `false` stops
};

/// One mesh on the way.
struct RefinementLevel {
  int unknowns = 0;
  double bound = 0, relative = 0;                        ///< certified
  double seconds = 0;                                    ///< wall clock since the start, everything in
  double predicted_unknowns = 0, predicted_seconds = 0;  ///< for the accuracy asked, from the third level on; else 0
};

/// The answer and its proof.
struct CertifiedSolution {
  Result result;  ///< of the element asked for, on the last mesh, with the locking report; its warning is that of the
                  ///< report and what the certificate cannot see of the load
  Solution companion;  ///< the displacement that is certified: u at the vertices, p per layer triangle; where the layer
                       ///< is bisected at small epsilon it lives on columns there, u interpolates it and p is empty
  Certificate certificate;
  std::vector<RefinementLevel> history;
};

/// Refines until the certificate says that the accuracy asked is reached, the algebraic error stopped at a tenth of the
/// bound. For epsilon <= 0.1 the body is bisected and the layer's columns are extruded below it; else everything is
/// bisected. `first` is the first mesh, of any body; where the layer is extruded, one of the body alone will do, and
/// the Ventcel layer is the scaled one with epsilon = 0. Refinement inherits its triangles' shapes: gmsh's at 1/h = 8
/// cost 6 % more unknowns than a fine mesh of gmsh's own, those at 1/h = 16 1 %. `progress` is called after every level.
///
/// A P1 answer is the companion itself, in K between the vertices, too; Crouzeix-Raviart beside it gives the flux. A P2
/// answer is as far from u as that P1 function is, and as it is from that (certified_distance). Where either locks, h
/// must come down to epsilon first: an end that needs more than the limit is told at once, with what locks.
///
/// Throws Error for an accuracy outside (0, 1), another element, a limit that cannot hold the first mesh, a scene and a
/// mesh that do not fit; NotConverged where the accuracy is not to be reached within the limit, with what is;
/// Interrupted where accuracy.follow says so.
CertifiedSolution solve_to(const Scene& scene, const TriangleMesh& first, const AccuracyGoal& accuracy,
                           const std::function<void(const RefinementLevel&)>& progress = {});

}  // namespace antilock
