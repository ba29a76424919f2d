#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Every triangle cut into four by its edge midpoints: triangle t becomes 4 t ... 4 t + 3, so that the parent of t is
/// t / 4 and a function on the mesh is one on its refinement. Regions, tags and the geometry are inherited.
TriangleMesh refined(const TriangleMesh& mesh);

/// Puts new vertices on the curves of the mesh's geometry: middle[e] is the row of `vertices` in the middle of edge e, -1
/// for none. An edge of the body's boundary whose ends are on a curve has its middle moved to the nearest point of it;
/// contact and Sigma stay on their line. Without a geometry nothing moves. Throws Error where gmsh cannot read it, and for
/// an edge whose ends are on no curve of it. Whether a triangle turned over is seen when the mesh is made.
void follow_geometry(const TriangleMesh& mesh, const std::vector<int>& middle, Points& vertices);
/// The name of what refinement makes of the mesh, for messages: `how`, and with a geometry what may have gone wrong.
std::string refinement_name(const TriangleMesh& mesh, const std::string& how);

}  // namespace antilock
