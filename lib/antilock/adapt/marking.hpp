#pragma once
#include <Eigen/Dense>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// How a mesh grows: everything is bisected, or the body alone, with the layer's columns extruded anew below it. A
/// feature of a thin layer crosses all of it, so that columns are the cheaper mesh for epsilon <= 0.1.
enum class Growth { bisect, extrude };

/// How much to mark: `share` and `fewest` of marked(), and no more than `most` (0: no limit) of the largest.
struct Marking {
  double share = 0.5, fewest = 0.05;
  int most = 0;
};

/// The largest indicators that make up `share` of their sum (Doerfler 1996), and at least the part `fewest` of their
/// number: without that, an obstacle of one needle takes twenty levels.
std::vector<bool> marked(const Eigen::VectorXd& indicator, const Marking& marking = {});

/// A mesh and, for Growth::extrude, the body that its layer stands under.
struct GrowingMesh {
  TriangleMesh mesh, body;
  int marks = 0;  ///< triangles and columns marked on the way to it
};
/// The next mesh: refined where the indicators (T) of the last one say so. A column's indicators count together, for
/// its edge of Sigma.
GrowingMesh grown(const GrowingMesh& last, Growth growth, double epsilon, const Eigen::VectorXd& indicator,
                  const Marking& marking = {});

/// Refines the body's triangles where the load varies between the points of the quadrature rule: 64 x 64 samples per
/// triangle are held against it. Returns what could not be resolved, as a warning, or nothing.
std::string resolve_load(TriangleMesh& mesh, const Field& load, int most_triangles);

}  // namespace antilock
