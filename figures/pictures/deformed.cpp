// Deformed bodies side by side, coloured by pressure, over the obstacle they are pressed on.
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "drawing/panel.hpp"
#include "pictures/pictures.hpp"
#include "pictures/solution_file.hpp"
#include "pictures/table.hpp"

namespace antilock::figures {
namespace {

/// Where a point was before it moved. Rounded: it is the same one in all its triangles, which may
/// have moved apart.
std::array<double, 2> at_rest(vtkPolyData& body, vtkIdType i) {
  vtkDataArray* moved = body.GetPointData()->GetArray("displacement");
  const auto rounded = [&](int k) {
    return 1e-9 * std::round(1e9 * (body.GetPoint(i)[k] - moved->GetComponent(i, k)));
  };
  return {rounded(0), rounded(1)};
}

/// The closed lines around the body before it moved: the edges of one triangle alone, each going on
/// where another ends.
std::vector<std::vector<std::array<double, 2>>> outlines(vtkPolyData& body) {
  std::set<std::array<std::array<double, 2>, 2>> border;
  for (vtkIdType cell = 0; cell < body.GetNumberOfCells(); ++cell) {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    body.GetCellPoints(cell, size, corners);
    for (int i = 0; i < 3; ++i) {
      const auto from = at_rest(body, corners[i]), to = at_rest(body, corners[(i + 1) % 3]);
      if (border.erase({to, from}) == 0) border.insert({from, to});
    }
  }
  std::vector<std::vector<std::array<double, 2>>> lines;
  while (!border.empty()) {
    auto& line = lines.emplace_back(1, (*border.begin())[0]);
    for (auto next = border.begin(); next != border.end() && (*next)[0] == line.back();
         next = border.lower_bound({line.back(), {-1e300, -1e300}})) {
      const auto &to = (*next)[1], &at = line.back(),
                 &before = line[line.size() < 2 ? 0 : line.size() - 2];
      const double turn =
          (at[0] - before[0]) * (to[1] - at[1]) - (at[1] - before[1]) * (to[0] - at[0]);
      if (line.size() < 2 || std::abs(turn) > 1e-9) line.push_back(at);  // straight on: one line
      line.back() = to;
      border.erase(next);
    }
  }
  return lines;
}

/// From places in the body to places on the page.
struct Frame {
  double x0, y0, scale;
  Point origin;
  Point operator()(double x, double y) const {
    return origin + Point{scale * (x - x0), scale * (y - y0)};
  }
};

/// Outside the scale: tension (or less than the scale begins with), and more than it ends with.
const Beyond heads{Colour{0.72, 0.72, 0.72}, palette::vermillion};

Colour colour_of(double pressure, const Range& range) {
  return pressure < range.low    ? *heads.below
         : pressure > range.high ? *heads.above
                                 : viridis((pressure - range.low) / (range.high - range.low));
}

void draw_body(Page& page, const Frame& at, vtkPolyData& body, const Range& range, double thin) {
  vtkDataArray* pressure = body.GetCellData()->GetScalars();
  std::vector<std::vector<Point>> triangles;
  for (vtkIdType cell = 0; cell < body.GetNumberOfCells(); ++cell) {
    vtkIdType size = 0;
    const vtkIdType* corners = nullptr;
    body.GetCellPoints(cell, size, corners);
    std::vector<Point> triangle;
    triangle.reserve(4);  // the first corner ends its outline, too
    for (int i = 0; i < 3; ++i)
      triangle.push_back(at(body.GetPoint(corners[i])[0], body.GetPoint(corners[i])[1]));
    page.fill(triangle, colour_of(pressure->GetTuple1(cell), range));
    triangle.push_back(triangle.front());
    triangles.push_back(triangle);
  }
  for (const auto& triangle : triangles) page.line(triangle, {thin, {0.25, 0.25, 0.25}});
}

/// The obstacle fills everything below its line; strips, since a polygon must be convex.
void draw_obstacle(Page& page, const Frame& at, const CsvTable& line, double bottom) {
  for (std::size_t i = 0; i + 1 < line.rows(); ++i) {
    const double x0 = line.number(i, "x"), x1 = line.number(i + 1, "x"), y0 = line.number(i, "y"),
                 y1 = line.number(i + 1, "y");
    page.fill({at(x0, bottom), at(x1, bottom), at(x1, y1), at(x0, y0)}, palette::pale);
    page.line({at(x0, y0), at(x1, y1)}, {5, palette::ink});
  }
}

}  // namespace

Page deformed_picture(const std::vector<Surface>& bodies, const DeformedStyle& style) {
  std::vector<vtkSmartPointer<vtkPolyData>> read;
  vtkBoundingBox seen;
  for (const Surface& body : bodies) {
    read.push_back(read_deformed(body.solution));
    seen.AddBounds(read.back()->GetBounds());
    for (const auto& line : outlines(*read.back()))
      for (const auto& [x, y] : line) seen.AddPoint(x, y, 0);
  }
  std::vector<double> values;
  for (const auto& body : read)
    for (vtkIdType cell = 0; cell < body->GetNumberOfCells(); ++cell)
      values.push_back(body->GetCellData()->GetScalars()->GetTuple1(cell));
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const Range range = style.range.value_or(drawn({*least, *most}));
  check(range);
  std::optional<CsvTable> obstacle;
  if (!style.obstacle.empty()) obstacle.emplace(style.obstacle);
  for (std::size_t i = 0; obstacle && i < obstacle->rows(); ++i)
    seen.AddPoint(obstacle->number(i, "x"), obstacle->number(i, "y"), 0);

  constexpr double gap = 70, margin = 40, head = 100, foot = 40;
  const double bar_room = colour_bar_room(range, 80, 280);
  const auto count = static_cast<double>(bodies.size());
  const double body_width = (Page::width - 2 * margin - bar_room - (count - 1) * gap) / count;
  const Frame unit{seen.GetBound(0), seen.GetBound(2), body_width / seen.GetLength(0), {0, 0}};
  const double body_height = unit.scale * seen.GetLength(1),
               bottom = seen.GetBound(2) - 0.02 * seen.GetLength(1);
  Page page(foot + body_height + head);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double left = margin + static_cast<double>(i) * (body_width + gap);
    const Frame at{unit.x0, unit.y0, unit.scale, {left, foot}};
    if (obstacle) draw_obstacle(page, at, *obstacle, bottom);
    draw_body(page, at, *read[i], range, 0.8);
    for (const auto& line : outlines(*read[i])) {
      std::vector<Point> points;
      points.reserve(line.size());
      for (const auto& [x, y] : line) points.push_back(at(x, y));
      page.line(points, {4, palette::ink, {22, 14}});
    }
    page.text({left + 0.5 * body_width, page.height() - 70.0}, bodies[i].title,
              {name_size, {0.5}, 0, palette::ink, body_width});
  }
  draw_colour_bar(
      page,
      {Page::width - bar_room + 80.0, foot + 0.2 * body_height, bar_width, 0.55 * body_height},
      range, style.name, heads);
  return page;
}

}  // namespace antilock::figures
