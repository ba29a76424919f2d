#include "antilock/mesh/graded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"

namespace antilock {
namespace {

void check_lines(const std::vector<double>& lines, const char* name) {
  const auto bad = [](double a, double b) { return !(b > a && std::isfinite(b - a)); };
  const auto found = std::adjacent_find(lines.begin(), lines.end(), bad);
  if (lines.size() < 2)
    throw Error(
        fmt::format("tensor mesh: {} {} line(s); accepted: two or more", lines.size(), name));
  if (found != lines.end())
    throw Error(fmt::format("tensor mesh: the {} lines {} and {}; accepted: ascending numbers",
                            name, *found, found[1]));
}

/// Adds lines from `at`, not included, to `end`: equal cells, as few as are no wider than `width`;
/// the one next to `at` is cut `layers` times, each cut leaving the share `ratio` next to `at`.
void add_lines(std::vector<double>& lines, double at, double end, double width, int layers,
               double ratio) {
  const double cells = std::max(1.0, std::ceil(std::abs(end - at) / width * (1 - 1e-12)));
  for (int k = layers; k > 0; --k) lines.push_back(at + (end - at) * std::pow(ratio, k) / cells);
  for (int j = 1; j < cells; ++j) lines.push_back(at + (end - at) * j / cells);
  lines.push_back(end);
}

}  // namespace

TriangleMesh tensor_mesh(const std::vector<double>& x, const std::vector<double>& y,
                         Diagonal diagonal) {
  check_lines(x, "x");
  check_lines(y, "y");
  if (std::find(y.begin(), y.end() - 1, 0.0) == y.end() - 1)
    throw Error(fmt::format("tensor mesh: y from {} to {}; accepted: a line y = 0 below the last",
                            y.front(), y.back()));
  if (static_cast<double>(x.size()) * static_cast<double>(y.size()) > 1 << 25)
    throw Error(fmt::format("tensor mesh: {} by {} lines; accepted: up to 2^25 crossings", x.size(),
                            y.size()));
  const int columns = static_cast<int>(x.size()) - 1, rows = static_cast<int>(y.size()) - 1;
  const int corners = (rows + 1) * (columns + 1), cells = rows * columns;
  const bool crossed = diagonal == Diagonal::crossed;
  Points vertices(corners + (crossed ? cells : 0), 2);
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) vertices.row(j * (columns + 1) + i) << x[i], y[j];
  Triples triangles((crossed ? 4 : 2) * cells, 3);
  int t = 0;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int low = j * (columns + 1) + i,
                up = low + columns + 1;  // lower left and upper left corner
      if (crossed) {
        const int centre = corners + j * columns + i;
        vertices.row(centre) = 0.5 * (vertices.row(low) + vertices.row(up + 1));
        triangles.row(t++) << low, low + 1, centre;
        triangles.row(t++) << low + 1, up + 1, centre;
        triangles.row(t++) << up + 1, up, centre;
        triangles.row(t++) << up, low, centre;
      } else if (diagonal == Diagonal::right) {
        triangles.row(t++) << low, low + 1, up + 1;
        triangles.row(t++) << low, up + 1, up;
      } else {
        triangles.row(t++) << low, low + 1, up;
        triangles.row(t++) << low + 1, up + 1, up;
      }
    }
  return tag_by_position(std::move(vertices), std::move(triangles));
}

TriangleMesh graded_mesh(double end, double width, int layers, double ratio, double epsilon) {
  if (!(end > 0 && end < 1 && epsilon >= 0 && epsilon <= 1))
    throw Error(fmt::format(
        "graded mesh: end {}, epsilon {}; accepted: 0 < end < 1, 0 <= epsilon <= 1", end, epsilon));
  if (!(width >= 1e-6 && layers >= 0 && layers <= 60 && ratio > 0 && ratio < 1))
    throw Error(
        fmt::format("graded mesh: width {}, {} layers, ratio {}; accepted: a width of a millionth "
                    "or more, 0 to "
                    "60 layers, a ratio between 0 and 1",
                    width, layers, ratio));
  const double wider =
      std::ceil(std::log(epsilon) / std::log(ratio));  // than epsilon; infinite at epsilon = 0
  const int in_body = static_cast<int>(std::min<double>(layers, wider));
  std::vector<double> x, y{-1};
  add_lines(x, end, 0, width, layers, ratio);
  std::reverse(x.begin(), x.end());
  x.push_back(end);
  add_lines(x, end, 1, width, layers, ratio);
  add_lines(y, -1, 0, width, layers - in_body, ratio);
  add_lines(y, 0, 1, width, in_body, ratio);
  return tensor_mesh(x, y);
}

}  // namespace antilock
