#pragma once
#include <filesystem>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"
#include "antilock/scene/scene.hpp"

namespace antilock {

/// Writes MSH 2.2 (ASCII). The physical groups are those of Figure 2 of [SR04] (cited in
/// problem/variational_inequality.hpp), and the groups of `edges`, which keep their names. Free
/// edges of no other group are in "free". The groups of tetrahedra are volumes and surfaces. Throws
/// Error, whose message begins with `path`, for quadrilaterals too, and leaves no partial file.
void write_msh(const std::filesystem::path& path, const TriangleMesh& mesh,
               const std::vector<BoundaryCondition>& edges = {});

}  // namespace antilock
