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

/// What a VTU file (VTK's unstructured grid, as text) holds here: triangles in the plane.
struct VtuGrid {
  Points points;
  Triples triangles;
  std::vector<VtuArray> point_data, cell_data;  ///< the first of each is the one that a viewer shows
  std::vector<std::string> region_names = {};   ///< of the numbers 0, 1, ... in the cell data `region`: field data
};

/// Throws Error, `path` first, where it cannot be written; no partial file is left.
void write_grid(const std::filesystem::path& path, const VtuGrid& grid);

}  // namespace antilock
