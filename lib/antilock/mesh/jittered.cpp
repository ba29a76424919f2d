// Between Figure 3 and Figure 6: the structured mesh with its vertices moved at random, as little as one likes.
#include <fmt/format.h>

#include <random>

#include "antilock/core/error.hpp"
#include "antilock/mesh/generate.hpp"

namespace antilock {

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
