// Figure 3: squares cut by a diagonal. Lines at equal distances, so written out: gmsh's transfinite
// meshes give the same triangles but take seconds where this takes milliseconds. And the same mesh
// with its vertices moved at random, as little as one likes, on the way to Figure 6.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "antilock/core/error.hpp"
#include "antilock/mesh/graded.hpp"

namespace antilock {

void check_mesh_request(int cells, int most, const Domain& domain) {
  if (cells < 1 || cells > most)
    throw Error(fmt::format("mesh: cells = {} is out of range; accepted 1 to {}", cells, most));
  if (!(domain.layer_depth >= 0 && domain.layer_depth <= 1))
    throw Error(
        fmt::format("mesh: layer depth {} is out of range; accepted 0 to 1", domain.layer_depth));
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

TriangleMesh jittered_mesh(int cells, double amount) {
  if (!(amount >= 0 && amount <= 0.2))
    throw Error(fmt::format("mesh: jitter {} is out of range; accepted 0 to 0.2 (of h)", amount));
  TriangleMesh mesh = structured_mesh(cells);
  std::vector<char> held(mesh.vertex_count(), 0);
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] != EdgeTag::interior) held[mesh.edges(e, 0)] = held[mesh.edges(e, 1)] = 1;
  // the generator's bits are the same everywhere, those of the library's distributions are not
  std::mt19937 random(2004);
  const auto shift = [&] { return (2.0 * random() / std::mt19937::max() - 1) * amount / cells; };
  for (int i = 0; i < mesh.vertex_count(); ++i) {
    const double dx = shift(), dy = shift();
    if (!held[i]) mesh.vertices.row(i) += Eigen::RowVector2d(dx, dy);
  }
  return mesh;
}

}  // namespace antilock
