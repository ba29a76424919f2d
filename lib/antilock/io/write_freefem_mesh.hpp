#pragma once
#include <filesystem>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// Writes the mesh in the native .msh format of FreeFEM: a line with the numbers of vertices,
/// triangles and labelled edges (nv nt nbe), then one line per vertex (x y label), per triangle (i
/// j k region) and per edge (i j label). The numbering is that of the mesh, and the labels are
/// those of physical_number and Region. A mesh of tetrahedra is written in Medit's format, which
/// FreeFEM's readmesh3 reads; its name must end in .mesh. The labels are those of its faces. Throws
/// Error, whose message begins with `path`, for quadrilaterals and where the file cannot be written,
/// and leaves no partial file.
void write_freefem_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace antilock
