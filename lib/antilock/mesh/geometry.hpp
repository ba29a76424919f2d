#pragma once
#include <filesystem>
#include <string>

namespace antilock {

/// The curves of the body's boundary, to which every refinement of a mesh returns
/// (mesh/refine.hpp).
struct Geometry {
  /// The .geo or .brep file; empty: there is none, and the boundary is the polygon of the mesh.
  std::string file = {};
  /// The text that gmsh reads in place of a .geo file (mesh/geometry_script.hpp).
  std::string script = {};

  bool empty() const { return file.empty(); }
};

/// Reads and checks a .geo file of up to 4 MB. Later changes of the file have no effect. A .brep
/// file is not read here: gmsh reads it itself, because it contains only data of OpenCASCADE and no
/// commands. Throws Error where there is no such file, or where geometry_script refuses the text.
Geometry read_geometry(const std::filesystem::path& file);

}  // namespace antilock
