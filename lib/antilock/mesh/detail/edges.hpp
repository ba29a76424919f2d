#pragma once
#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Fills edges, triangle_edges and edge_triangles from vertices and triangles, in linear time; every edge_tag becomes
/// interior, or sigma where body meets layer. `where` opens the message of the Error for an edge of three triangles.
void number_edges(TriangleMesh& mesh, const std::string& where);

/// Sets the tags of boundary edges; throws Error for a tag on an edge that the mesh does not have.
void tag_edges(TriangleMesh& mesh, const std::vector<TaggedEdge>& tagged_edges, const std::string& where);

}  // namespace antilock
