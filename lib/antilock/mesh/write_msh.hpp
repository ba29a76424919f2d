#pragma once
#include <filesystem>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// Writes MSH 2.2 (ASCII) with the physical groups of Figure 2 of [SR04] (cited in
/// problem/variational_inequality.hpp) and, with their names, those of `edges`. Free edges of no
/// other group are in "free". Throws Error, `path` first, and leaves no partial file.
void write_msh(const std::filesystem::path& path, const TriangleMesh& mesh,
               const std::vector<BoundaryCondition>& edges = {});

}  // namespace antilock
