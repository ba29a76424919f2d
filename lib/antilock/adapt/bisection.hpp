#pragma once
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Newest-vertex bisection, with red refinement where all edges of a triangle are halved (Carstensen 2004). A triangle is
/// halved from its newest vertex, its vertex 0, to the middle of the edge opposite, its edge 0; the middle is the newest
/// vertex of both halves. Where all three edges are halved it falls into four triangles like itself. Either way a first
/// triangle has no descendants of more than four shapes, so that no angle becomes small. Every triangle of `triangles`
/// (T) is cut into four, every edge of `edges` (E; empty: none) is halved, and whatever else keeps the mesh conforming is
/// halved, too. Regions and tags are inherited, vertices keep their numbers. Works on any mesh: call longest_edge_first
/// once, on the first one. Throws Error for marks of another number.
TriangleMesh bisected(const TriangleMesh& mesh, const std::vector<bool>& triangles,
                      const std::vector<bool>& edges = {});

/// The same mesh with each triangle's vertices turned round until its longest edge lies opposite vertex 0.
TriangleMesh longest_edge_first(TriangleMesh mesh);

}  // namespace antilock
