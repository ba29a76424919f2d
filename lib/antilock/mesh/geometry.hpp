#pragma once
#include <filesystem>
#include <string>

namespace antilock {

/// The curves of the body's boundary, to which every refinement of a mesh returns
/// (mesh/refine.hpp).
struct Geometry {
  std::string file = {};    ///< the .geo or .brep file; empty: there is none, the boundary is the mesh's polygon
  std::string script = {};  ///< of a .geo file: the text that gmsh reads in its place (mesh/geometry_script.hpp)

  bool empty() const { return file.empty(); }
};

/// Reads and checks a .geo file, up to 4 MB: later changes of the file change nothing. A .brep file
/// is left where it is. It holds data of OpenCASCADE, which nothing executes. Throws Error where
/// there is no such file, or where geometry_script refuses the text.
Geometry read_geometry(const std::filesystem::path& file);

}  // namespace antilock
