// Layers of congruent triangles: two lines of equally spaced vertices, one of them shifted by half a space, zipped
// together. Lines across give rows of triangles, lines upwards columns.
#include <fmt/format.h>

#include "antilock/core/error.hpp"
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

/// `strips` of triangles with a side of 1/cells in the layer, across or upright; each vertex of Sigma has a line of the
/// body's squares above it.
TriangleMesh lattice(int cells, int strips, bool upright) {
  check_mesh_request(cells, 2048, {});
  check_mesh_request(strips, 4096, {});
  std::vector<Eigen::Vector2d> at;      // along a line, and across the lines
  std::vector<std::vector<int>> lines;  // from Gamma_C upwards, or from left to right
  for (int j = -strips; j <= (upright ? 0 : cells); ++j) {
    std::vector<double> along = spaced(cells, j < 0 && j % 2 != 0);
    if (upright) {
      for (double& y : along) y -= 1;
      for (int i = 1; i <= cells; ++i) along.push_back(static_cast<double>(i) / cells);
    }
    lines.emplace_back();
    const double across = static_cast<double>(j) / (j < 0 ? strips : cells) + (upright ? 1 : 0);
    for (const double s : along) {
      lines.back().push_back(static_cast<int>(at.size()));
      at.emplace_back(s, across);
    }
  }
  Points vertices(static_cast<Eigen::Index>(at.size()), 2);
  for (std::size_t i = 0; i < at.size(); ++i)
    vertices.row(static_cast<Eigen::Index>(i)) << at[i](upright ? 1 : 0), at[i](upright ? 0 : 1);

  std::vector<int> corners;
  std::vector<Region> region;
  std::vector<TaggedEdge> tagged;
  for (std::size_t j = 0; j + 1 < lines.size(); ++j) {
    const std::vector<int>&one = lines[j], &next = lines[j + 1];
    for (std::size_t l = 0, u = 0; l + 1 < one.size() || u + 1 < next.size();) {  // whose edge has its middle first
      const auto middle = [&](const std::vector<int>& line, std::size_t i) {
        return at[line[i]].x() + at[line[i + 1]].x();
      };
      const bool ours = u + 1 == next.size() || (l + 1 < one.size() && middle(one, l) <= middle(next, u));
      corners.insert(corners.end(), {one[l], ours ? one[l + 1] : next[u + 1], next[u]});
      region.push_back(vertices(one[l], 1) + vertices(next[u], 1) + vertices(*(corners.end() - 2), 1) > 0
                           ? Region::body
                           : Region::layer);
      ours ? ++l : ++u;
    }
    tagged.push_back({one.front(), next.front(), upright ? EdgeTag::contact : EdgeTag::clamped});
    tagged.push_back({one.back(), next.back(), EdgeTag::clamped});
  }
  for (const auto* line : {&lines.front(), &lines.back()})
    for (std::size_t i = 0; i + 1 < line->size(); ++i) {
      const bool bottom = !upright && line == &lines.front();
      tagged.push_back({(*line)[i], (*line)[i + 1], bottom ? EdgeTag::contact : EdgeTag::clamped});
    }
  Triples triangles = Eigen::Map<Triples>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
  return make_triangle_mesh(std::move(vertices), std::move(triangles), std::move(region), tagged, "lattice");
}

}  // namespace

TriangleMesh rows_mesh(int cells, int rows) { return lattice(cells, rows, false); }
TriangleMesh columns_mesh(int cells, int columns) { return lattice(cells, columns, true); }

}  // namespace antilock
