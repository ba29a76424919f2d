#pragma once
#include <filesystem>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Writes the mesh in the native .msh format of FreeFEM: nv nt nbe; x y label; i j k region; i j
/// label. The numbering is that of the mesh, and the labels are those of physical_number and
/// Region. Throws Error, `path` first, and leaves no partial file.
void write_freefem_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace antilock
