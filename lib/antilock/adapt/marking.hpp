#pragma once
#include <Eigen/Dense>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// The refinement strategy: everything is bisected, or the body alone, with the layer's columns extruded anew below
/// it. A feature of a thin layer crosses all of it, so that columns are the cheaper mesh for epsilon <= 0.1.
enum class RefinementStrategy { bisect, extrude };

/// Doerfler's marking: the largest indicators that make up `theta` of the sum are marked, but at least `min_fraction`
/// of their number (without that, an obstacle of one needle takes twenty levels) and at most `max_marked` (0: no
/// limit).
struct Marking {
  double theta = 0.5, min_fraction = 0.05;
  int max_marked = 0;
  /// Where more than this fraction is needed, the error is spread evenly: all are marked, and the triangles keep their
  /// shapes (only where `max_marked` allows it).
  double uniform_above = 0.2;
};

/// Doerfler's marking (1996): true for those to refine.
std::vector<bool> dorfler_mark(const Eigen::VectorXd& indicator, const Marking& marking = {});

/// A mesh and, for RefinementStrategy::extrude, the body that its layer stands under.
struct AdaptiveMesh {
  TriangleMesh mesh, body;
  int marks = 0;  ///< triangles and columns marked on the way to it
};
/// The next mesh: refined where the indicators (T) of the last one say so. A column's indicators count together, for
/// its edge of Sigma.
AdaptiveMesh refine_marked(const AdaptiveMesh& last, RefinementStrategy strategy, double epsilon,
                           const Eigen::VectorXd& indicator, const Marking& marking = {});

/// Refines the body's triangles where the load varies between the points of the quadrature rule. The integrals of f^2 and
/// of f |f| by up to 2,080 samples per triangle, a million in all, are held against those by the rule. A triangle misses
/// what it is off by, if that is more than a tenth of its own integral of f^2. It goes on until each triangle misses less
/// than a thousandth of the whole integral of f^2, and all of them together less than a tenth. Returns what could not be
/// resolved, as a warning, or nothing.
std::string resolve_load(TriangleMesh& mesh, const Field& load, int most_triangles);

}  // namespace antilock
