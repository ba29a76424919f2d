// Figure 3: squares cut by a diagonal. Lines at equal distances, so written out: gmsh's transfinite meshes give the same
// triangles (a test holds the two together) but take seconds where this takes milliseconds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"
#include "antilock/mesh/graded.hpp"

namespace antilock {

void check_mesh_request(int cells, int most, const Domain& domain) {
  if (cells < 1 || cells > most)
    throw Error(fmt::format("mesh: cells = {} is out of range; accepted 1 to {}", cells, most));
  if (!(domain.layer_depth >= 0 && domain.layer_depth <= 1))
    throw Error(fmt::format("mesh: layer depth {} is out of range; accepted 0 to 1", domain.layer_depth));
}

TriangleMesh structured_mesh(int cells, const Domain& domain, Diagonal diagonal) {
  check_mesh_request(cells, 2048, domain);
  const double depth = domain.layer_depth;
  const int layer_rows = depth > 0 ? std::max(2, static_cast<int>(std::lround(depth * cells))) : 0;
  std::vector<double> x, y;
  for (int i = 0; i <= cells; ++i) x.push_back(static_cast<double>(i) / cells);
  for (int j = layer_rows; j > 0; --j) y.push_back(-depth * j / layer_rows);
  y.insert(y.end(), x.begin(), x.end());
  return tensor_mesh(x, y, diagonal);
}

}  // namespace antilock
