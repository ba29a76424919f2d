#pragma once
#include <Eigen/Dense>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// The refinement strategy. bisect: all triangles may be bisected. extrude: only triangles of the
/// body are bisected, and the layer is extruded again below the body, in columns. A feature of a
/// thin layer crosses the whole layer, so that columns are the cheaper mesh for epsilon <= 0.1.
enum class RefinementStrategy { bisect, extrude };

/// Parameters of Doerfler's marking. The triangles with the largest indicators are marked until
/// their indicators add up to the fraction `theta` of the sum. At least the fraction `min_fraction`
/// of all triangles is marked (without this limit an obstacle with one narrow peak takes twenty
/// levels), and at most `max_marked` triangles (0: no limit).
struct Marking {
  double theta = 0.5, min_fraction = 0.05;
  int max_marked = 0;
  /// If more than this fraction of all triangles would be marked, the error is spread evenly over
  /// the mesh. Then all are marked, if `max_marked` allows it, so that the triangles keep their
  /// shapes.
  double uniform_above = 0.2;
};

/// Returns true for the triangles to refine (W. Doerfler, SIAM J. Numer. Anal. 33, 1996).
std::vector<bool> dorfler_mark(const Eigen::VectorXd& indicator, const Marking& marking = {});

/// A mesh and, for RefinementStrategy::extrude, the mesh of only its body.
struct AdaptiveMesh {
  TriangleMesh mesh, body;
  int marks = 0;  ///< triangles and columns that were marked in the last refinement
};
/// Returns the next mesh, refined by the indicators (T, of the last mesh). For
/// RefinementStrategy::extrude the indicators of a column are added, and they mark its edge of
/// Sigma, the interface of body and layer.
AdaptiveMesh refine_marked(const AdaptiveMesh& last, RefinementStrategy strategy, double epsilon,
                           const Eigen::VectorXd& indicator, const Marking& marking = {});

/// Refines the body's triangles where the load f varies between the points of the quadrature rule.
/// On each triangle T the integrals of f^2 and of f |f| by up to 2,080 samples (a million in all)
/// are compared with those by the rule. The indicator of T is its quadrature error if this is above
/// 10 % of int_T f^2, and 0 otherwise. Refinement ends when every indicator is at most a thousandth
/// of the whole integral of f^2, and their sum at most a tenth. Returns an empty text, or a warning
/// where `most_triangles` or 16 rounds do not suffice.
std::string resolve_load(TriangleMesh& mesh, const Field& load, int most_triangles);

}  // namespace antilock
