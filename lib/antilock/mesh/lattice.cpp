// Layers of congruent triangles: two lines of equally spaced vertices, one of them shifted by half
// a space, zipped together. Lines across give rows of triangles, lines upwards columns.
#include "antilock/mesh/generate.hpp"

namespace antilock {
namespace {

/// 0, 1/n, ..., 1; shifted: 0, 1/(2n), 3/(2n), ..., 1.
std::vector<double> spaced(int n, bool shifted) {
  std::vector<double> at{0};
  for (int i = 1; i <= n; ++i) at.push_back((shifted ? i - 0.5 : i) / n);
  if (shifted) at.push_back(1);
  return at;
}

/// `strips` of triangles with a side of 1/cells in the layer, across or upright; each vertex of
/// Sigma has a line of the body's squares above it.
TriangleMesh lattice(int cells, int strips, bool upright) {
  check_mesh_request(cells, most_structured, {});
  check_mesh_request(strips, 4096, {});
  std::vector<Eigen::RowVector2d> vertices;
  std::vector<std::vector<int>> lines;  // from Gamma_C upwards, or from left to right
  for (int j = -strips; j <= (upright ? 0 : cells); ++j) {
    std::vector<double> along = spaced(cells, j < 0 && j % 2 != 0);
    if (upright) {
      for (double& y : along) y -= 1;
      for (int i = 1; i <= cells; ++i) along.push_back(static_cast<double>(i) / cells);
    }
    lines.emplace_back();
    const int divisions = j < 0 ? strips : cells;
    const double level = static_cast<double>(j) / divisions;  // y across; x - 1 upright
    for (const double s : along) {
      lines.back().push_back(static_cast<int>(vertices.size()));
      if (upright)
        vertices.emplace_back(level + 1, s);
      else
        vertices.emplace_back(s, level);
    }
  }
  std::vector<Eigen::RowVector3i> triangles;
  for (std::size_t j = 0; j + 1 < lines.size(); ++j) {
    const std::vector<int>&one = lines[j], &next = lines[j + 1];
    const int along = upright ? 1 : 0;  // the coordinate that grows along a line
    const auto twice_the_middle = [&](const std::vector<int>& line, std::size_t i) {
      return vertices[line[i]](along) + vertices[line[i + 1]](along);
    };
    for (std::size_t l = 0, u = 0;
         l + 1 < one.size() || u + 1 < next.size();) {  // whose edge has its middle first
      const bool ours =
          u + 1 == next.size() ||
          (l + 1 < one.size() && twice_the_middle(one, l) <= twice_the_middle(next, u));
      const int third = ours ? one[l + 1] : next[u + 1];
      if (upright)
        triangles.emplace_back(one[l], next[u], third);
      else
        triangles.emplace_back(one[l], third, next[u]);
      ++(ours ? l : u);
    }
  }
  return tag_by_position(
      Eigen::Map<Points>(vertices[0].data(), static_cast<Eigen::Index>(vertices.size()), 2),
      Eigen::Map<Triples>(triangles[0].data(), static_cast<Eigen::Index>(triangles.size()), 3));
}

}  // namespace

TriangleMesh rows_mesh(int cells, int rows) { return lattice(cells, rows, false); }
TriangleMesh columns_mesh(int cells, int columns) { return lattice(cells, columns, true); }

}  // namespace antilock
