#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Returns the mesh with every triangle cut into four by its edge midpoints. Triangle t becomes 4 t
/// ... 4 t + 3, so that the parent of t is t / 4. A continuous function that is affine on the old
/// triangles is so on the new ones. Regions, tags and the geometry are inherited.
TriangleMesh refined(const TriangleMesh& mesh);

/// Puts new vertices on the curves of the geometry of the mesh. `middle` has one entry per edge e:
/// the index of the row of `vertices` that holds the midpoint of e, or -1 if e has no midpoint.
/// Where an edge of the boundary of the body has its ends on a curve, its middle moves to the
/// nearest point of that curve. Contact and Sigma edges stay on their line. Without a geometry
/// nothing moves. Throws Error where gmsh cannot read the geometry, and for an edge whose ends are
/// on no curve of it. A triangle that turns over is detected later, when the mesh is made.
void follow_geometry(const TriangleMesh& mesh, const std::vector<int>& middle, Points& vertices);
/// Returns the name of the refined mesh in messages. It is `how`, followed by the probable reason
/// of an error if the mesh has a geometry.
std::string refinement_name(const TriangleMesh& mesh, const std::string& how);

}  // namespace antilock
