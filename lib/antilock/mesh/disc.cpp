// The unit disc: ring k of 6 k vertices on the circle of radius k / rings, as in a mesh of
// equilateral triangles of the hexagon. No angle is above 90 degrees by more than the curvature of
// an edge.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "antilock/core/error.hpp"
#include "antilock/mesh/generate.hpp"

namespace antilock {

TriangleMesh disc_mesh(int rings) {
  if (rings < 1 || rings > 512)
    throw Error(fmt::format("disc mesh: {} rings; accepted 1 to 512", rings));
  const auto vertex = [](int ring, int place) {
    return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1) + place % (6 * ring);
  };
  Points vertices = Points::Zero(1 + 3 * rings * (rings + 1), 2);
  Triples triangles(6 * rings * rings, 3);
  std::vector<TaggedEdge> rim;
  int t = 0;
  for (int k = 0; k < rings; ++k) {
    const int next = k + 1;
    for (int i = 0; i < 6 * next; ++i) {
      const double angle = 2 * std::numbers::pi * i / (6 * next);
      vertices.row(vertex(next, i)) << std::cos(angle) * next / rings,
          std::sin(angle) * next / rings;
      if (next == rings) rim.push_back({vertex(next, i), vertex(next, i + 1), EdgeTag::clamped});
    }
    for (int sector = 0; sector < 6; ++sector)
      for (int i = 0; i <= k; ++i) {
        const int inner = sector * k + i, outer = sector * next + i;
        triangles.row(t++) << vertex(k, inner), vertex(next, outer), vertex(next, outer + 1);
        if (i < k)
          triangles.row(t++) << vertex(k, inner), vertex(next, outer + 1), vertex(k, inner + 1);
      }
  }
  std::vector<Region> body(t, Region::body);
  return make_mesh(std::move(vertices), std::move(triangles), std::move(body), rim, "disc mesh");
}

}  // namespace antilock
