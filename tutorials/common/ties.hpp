#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock::tutorial {

/// The layer's triangles in groups: two that share an edge which is not vertical are tied together, and so are those that
/// they are tied to. A group's number per triangle, from 0 on from left to right; -1 in the body.
struct Ties {
  std::vector<int> group;
  int groups = 0;
};
Ties ties(const TriangleMesh& mesh);

/// The layers of two or more meshes side by side, their triangles coloured by group, as a table of shapes that
/// figures/pictures/domain.cpp reads.
void draw_ties(const std::filesystem::path& path, const std::vector<std::pair<std::string, TriangleMesh>>& meshes);

/// The smallest angle of all triangles, in degrees.
double smallest_angle(const TriangleMesh& mesh);

}  // namespace antilock::tutorial
