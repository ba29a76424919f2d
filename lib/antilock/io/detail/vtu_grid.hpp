#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "antilock/mesh/triangle_mesh.hpp"

namespace antilock {

/// One array of a VTU file: n x components numbers.
struct VtuArray {
  std::string name;
  Eigen::MatrixXd values;
  bool integers = false;  ///< written as Int32
};

/// What a VTU file (VTK's unstructured grid) holds here: triangles in the plane. The arrays are written as raw bytes
/// behind the XML (little-endian doubles and integers): a million triangles as text take ten times the seconds.
struct VtuGrid {
  Points points;
  Triples triangles;
  std::vector<VtuArray> point_data, cell_data;  ///< the first of each is the one that a viewer shows
  std::vector<std::string> region_names = {};   ///< of the numbers 0, 1, ... in the cell data `region`: field data
};

/// Throws Error, `path` first, where it cannot be written; no partial file is left.
void write_grid(const std::filesystem::path& path, const VtuGrid& grid);

}  // namespace antilock
