#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Fills edges, triangle_edges and edge_triangles from vertices and triangles, in linear time; every edge_tag becomes
/// interior, or sigma where body meets layer. `where` opens the message of the Error for an edge of three triangles.
void number_edges(TriangleMesh& mesh, const std::string& where);

/// The mesh of a generator, whose triangles are counterclockwise and need no check. Its parts are told by their places
/// (Figure 2): the layer lies below y = 0, the lowest line is Gamma_C, all other sides are clamped.
TriangleMesh placed_mesh(Points vertices, Triples triangles);

}  // namespace antilock
