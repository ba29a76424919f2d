#pragma once
#include <filesystem>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// FreeFEM's native .msh: nv nt nbe; x y label; i j k region; i j label. The same numbering, labels as in
/// physical_number and Region. Throws Error, `path` first, and leaves no partial file.
void write_freefem_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace antilock
