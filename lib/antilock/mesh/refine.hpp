#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Every triangle cut into four by its edge midpoints: triangle t becomes 4 t ... 4 t + 3, so that the father of t is
/// t / 4 and a function on the mesh is one on its refinement. Regions and tags are inherited (clamped and contact; a
/// mesh with free edges is refused).
TriangleMesh refined(const TriangleMesh& mesh);

}  // namespace antilock
