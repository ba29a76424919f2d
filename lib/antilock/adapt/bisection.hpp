#pragma once
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Refines a mesh by newest-vertex bisection, with red refinement where all edges of a triangle are
/// halved (C. Carstensen, Constr. Approx. 20, 2004). The newest vertex of a triangle is its vertex
/// 0, and edge 0 lies opposite. A triangle is halved by the line from its newest vertex to the
/// midpoint of edge 0. This midpoint is the newest vertex of both halves. Where all three edges are
/// halved, it is divided into four triangles similar to it. Either way the descendants of a
/// triangle of the first mesh have at most four shapes, so that angles stay bounded below. Every
/// triangle of `triangles` (T marks) is divided into four, every edge of `edges` (E marks, or empty
/// for none) is halved, and so is every further edge that a conforming mesh needs. Regions and tags
/// are inherited, vertices keep their numbers. The first mesh may be any mesh, after one call of
/// longest_edge_first. Throws Error for another number of marks.
TriangleMesh bisected(const TriangleMesh& mesh, const std::vector<bool>& triangles,
                      const std::vector<bool>& edges = {});

/// Returns the same mesh with the vertices of each triangle rotated so that its longest edge lies
/// opposite vertex 0.
TriangleMesh longest_edge_first(TriangleMesh mesh);

}  // namespace antilock
