// Figure 3: squares cut by a diagonal. Lines at equal distances, so written out: gmsh's transfinite
// meshes give the same triangles but take seconds where this takes milliseconds. And the same mesh
// with its vertices moved at random, as little as one likes, on the way to Figure 6.
#include <fmt/format.h>

#include <algorithm>
#include <array>
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

namespace {

/// The crossings of the lines x and y.
Mesh rectangles(const std::vector<double>& x, const std::vector<double>& y) {
  const int columns = static_cast<int>(x.size()), rows = static_cast<int>(y.size());
  Points vertices(columns * rows, 2);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) vertices.row(j * columns + i) << x[i], y[j];
  IndexRows cells((columns - 1) * (rows - 1), 4);
  int t = 0;
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const int low = j * columns + i;
      cells.row(t++) << low, low + 1, low + columns + 1, low + columns;
    }
  return tag_by_position(std::move(vertices), std::move(cells), CellKind::quadrilateral);
}

/// The boxes between the planes x, y = x and z, each cut into the six tetrahedra around its
/// diagonal. A tetrahedron goes from the lowest corner to the highest one along one axis after the
/// other. So it has an edge parallel to each axis.
Mesh cut_boxes(const std::vector<double>& x, const std::vector<double>& z) {
  const int across = static_cast<int>(x.size()), levels = static_cast<int>(z.size());
  const std::array<int, 3> step{1, across, across * across};  // to the next vertex along an axis
  Points vertices(levels * step[2], 3);
  for (int k = 0; k < levels; ++k)
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < across; ++i)
        vertices.row(k * step[2] + j * step[1] + i) << x[i], x[j], z[k];
  constexpr std::array<std::array<int, 3>, 6> orders{{{0, 1, 2},
                                                      {1, 2, 0},
                                                      {2, 0, 1},
                                                      {0, 2, 1},
                                                      {1, 0, 2},
                                                      {2, 1, 0}}};  // the second three are odd
  IndexRows cells(6 * (across - 1) * (across - 1) * (levels - 1), 4);
  int t = 0;
  for (int k = 0; k + 1 < levels; ++k)
    for (int j = 0; j + 1 < across; ++j)
      for (int i = 0; i + 1 < across; ++i)
        for (std::size_t o = 0; o < orders.size(); ++o) {
          const auto& [first, second, third] = orders[o];
          const int low = k * step[2] + j * step[1] + i;
          const int one = low + step[first], two = one + step[second], high = two + step[third];
          if (o < 3)
            cells.row(t++) << low, one, two, high;
          else
            cells.row(t++) << low, one, high, two;
        }
  return tag_by_position(std::move(vertices), std::move(cells), CellKind::tetrahedron);
}

}  // namespace

TriangleMesh structured_mesh(int cells, const Domain& domain, Diagonal diagonal) {
  const bool in_space = domain.kind == CellKind::tetrahedron;
  check_mesh_request(cells, in_space ? most_structured_in_space : most_structured, domain);
  const double depth = domain.layer_depth;
  const int layer_rows = depth > 0 ? std::max(2, static_cast<int>(std::lround(depth * cells))) : 0;
  std::vector<double> x, y;
  for (int i = 0; i <= cells; ++i) x.push_back(static_cast<double>(i) / cells);
  for (int j = layer_rows; j > 0; --j) y.push_back(-depth * j / layer_rows);
  y.insert(y.end(), x.begin(), x.end());
  if (in_space) return cut_boxes(x, y);
  if (domain.kind == CellKind::quadrilateral) return rectangles(x, y);
  return tensor_mesh(x, y, diagonal);
}

TriangleMesh jittered_mesh(int cells, double amount, const Domain& domain) {
  if (!(amount >= 0 && amount <= 0.2))
    throw Error(fmt::format("mesh: jitter {} is out of range; accepted 0 to 0.2 (of h)", amount));
  TriangleMesh mesh = structured_mesh(cells, domain);
  std::vector<char> held(mesh.vertex_count(), 0);
  for (int e = 0; e < mesh.edge_count(); ++e)
    if (mesh.edge_tag[e] != EdgeTag::interior)
      for (const int v : mesh.edges.row(e)) held[v] = 1;
  // the generator's bits are the same everywhere, those of the library's distributions are not
  std::mt19937 random(2004);
  const auto shift = [&] { return (2.0 * random() / std::mt19937::max() - 1) * amount / cells; };
  for (int i = 0; i < mesh.vertex_count(); ++i) {
    Eigen::RowVector3d way = Eigen::RowVector3d::Zero();
    for (int k = 0; k < mesh.dimension(); ++k) way(k) = shift();
    if (!held[i]) mesh.vertices.row(i) += way.head(mesh.dimension());
  }
  for (int t = 0; t < mesh.triangle_count(); ++t)
    if (!(mesh.measure(t) > 0))
      throw Error(fmt::format("mesh: jitter {} turns a {} over; accepted: a smaller one", amount,
                              mesh.reference().name));
  return mesh;
}

}  // namespace antilock
