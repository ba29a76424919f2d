// A quantity over a plane of two parameters as filled contours, such as the error over (epsilon,
// h).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "antilock/core/error.hpp"
#include "drawing/panel.hpp"
#include "pictures/pictures.hpp"
#include "pictures/selection.hpp"

namespace antilock::figures {
namespace {

/// A corner of a cell: its place on the page and the logarithm of the quantity.
struct Corner {
  Point at;
  double z;
};

/// The part of a polygon where side * (z - level) >= 0, z affine along its edges.
std::vector<Corner> clipped(const std::vector<Corner>& polygon, double level, double side) {
  std::vector<Corner> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double za = side * (a.z - level), zb = side * (b.z - level);
    if (za >= 0) kept.push_back(a);
    if ((za >= 0) != (zb >= 0)) kept.push_back({a.at + (za / (za - zb)) * (b.at - a.at), level});
  }
  return kept;
}

/// Bands of equal width in log10 z: half a decade, or a tenth where there are not two decades.
struct Bands {
  Bands(double least, double most)
      : step(most - least < 2 ? 0.1 : 0.5),
        low(std::floor(least / step) * step),
        high(std::max(std::ceil(most / step), std::floor(least / step) + 1) * step) {}
  double step, low, high;  // log10
  int count() const { return static_cast<int>(std::lround((high - low) / step)); }
  Colour colour(int band) const { return viridis((band + 0.5) / count()); }
};

void fill_triangle(Page& page, const std::vector<Corner>& triangle, const Bands& bands) {
  for (int band = 0; band < bands.count(); ++band) {
    const double from = bands.low + band * bands.step;
    const auto part = clipped(clipped(triangle, from, 1), from + bands.step, -1);
    if (part.size() < 3) continue;
    std::vector<Point> corners;
    corners.reserve(part.size());
    for (const Corner& corner : part) corners.push_back(corner.at);
    page.fill(corners, bands.colour(band));
  }
}

/// Panel name -> x -> y -> log10 z.
using Grids = std::map<std::string, std::map<double, std::map<double, double>>>;

void draw_map(Page& page, const Panel& panel,
              const std::map<double, std::map<double, double>>& grid, const Bands& bands) {
  for (auto column = grid.begin(); column != grid.end() && std::next(column) != grid.end();
       ++column) {
    const auto& [x0, left] = *column;
    const auto& [x1, right] = *std::next(column);
    for (auto cell = left.begin(); cell != left.end() && std::next(cell) != left.end(); ++cell) {
      const double y0 = cell->first, y1 = std::next(cell)->first;
      if (!right.contains(y0) || !right.contains(y1))
        continue;  // a run that is missing leaves a hole
      const Corner a{panel(x0, y0), cell->second}, b{panel(x1, y0), right.at(y0)};
      const Corner c{panel(x1, y1), right.at(y1)}, d{panel(x0, y1), std::next(cell)->second};
      const Corner middle{0.25 * (a.at + b.at + c.at + d.at), 0.25 * (a.z + b.z + c.z + d.z)};
      for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, d}, {d, a}})
        fill_triangle(page, {from, to, middle}, bands);
    }
  }
}

void draw_scale(Page& page, const Box& box, const Bands& bands, const std::string& name) {
  constexpr double size = number_size;
  for (int band = 0; band < bands.count(); ++band)
    page.fill(Box{box.x, box.y + band * box.height / bands.count(), box.width,
                  box.height / bands.count()},
              bands.colour(band));
  page.rectangle(box, {2.5});
  double widest = 0;
  for (int level = 0; level <= bands.count();
       ++level) {  // every level line has its number, to two digits
    const double y = box.y + level * box.height / bands.count(),
                 value = std::pow(10, bands.low + level * bands.step);
    page.line({{box.right(), y}, {box.right() + 12, y}}, {2.5});
    const std::string number = number_markup(std::stod(fmt::format("{:.2g}", value)));
    page.text({box.right() + 24, y}, number, {size, {0, Anchor::Height::middle}});
    widest = std::max(widest, page.text_width(number, size));
  }
  page.text({box.right() + 24 + widest + 24 + name_size, box.centre().y}, name,
            {name_size, {0.5}, 90});
}

}  // namespace

Page map_picture(const std::filesystem::path& file, const MapStyle& style) {
  const CsvTable table(file);
  Grids grids;
  Meanings panels;
  std::vector<double> xs, ys, zs;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!selected(table, row, style.filters)) continue;
    const double x = table.number(row, style.x), y = table.number(row, style.y),
                 z = table.number(row, style.z);
    if (!(x > 0 && y > 0 && z > 0 && std::isfinite(x + y + z))) continue;
    const Meaning panel = row_meaning(table, row, style.panel_by);
    panels.add(panel);
    grids[panel.name][x][y] = std::log10(z);
    xs.push_back(x), ys.push_back(y), zs.push_back(std::log10(z));
  }
  if (zs.empty())
    throw Error(
        fmt::format("{}: no row to draw: {}, {} and {} are finite and above 0 in none; accepted: "
                    "one such row or more",
                    file.string(), style.x, style.y, style.z));
  const auto [x_low, x_high] = std::minmax_element(xs.begin(), xs.end());
  const auto [y_low, y_high] = std::minmax_element(ys.begin(), ys.end());
  const auto [z_low, z_high] = std::minmax_element(zs.begin(), zs.end());
  const Bands bands(*z_low, *z_high);

  const std::size_t count = panels.size(), columns = panel_columns(count), rows = panel_rows(count);
  const double panel_height = rows > 1 ? 560 : 760, gap_x = 60, gap_y = head_margin + 30;
  const double head = head_margin + (style.title.empty() ? 0 : 90), foot = foot_margin + 10,
               scale_room = 330;
  const double rows_height =
      static_cast<double>(rows) * panel_height + static_cast<double>(rows - 1) * gap_y;
  Page page(rows_height + head + foot);
  const Axis y =
      style.y == "h" ? Axis::halving(*y_low, *y_high, 0) : Axis::logarithmic(*y_low, *y_high, 0);
  const double left = left_margin(page, y);
  const Box area{left, foot, Page::width - left - scale_room, rows_height};
  const auto boxes = arrange_panels(count, area, gap_x, gap_y);
  const Axis x = Axis::logarithmic(*x_low, *x_high, 0.0, static_cast<int>(boxes[0].width / 170));
  const auto titles = panels.names([&](const auto& names) {
    return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
      return page.text_width(name, name_size) <= boxes[0].width;
    });
  });
  for (std::size_t i = 0; i < count; ++i) {
    const Panel panel{boxes[i], x, y};
    draw_map(page, panel, grids.at(panels[i].name), bands);
    draw_frame(page, panel,
               {titles[i], i + columns >= count ? style.x_name : "",
                i % columns == 0 ? style.y_name : ""});
  }
  draw_scale(page, {area.right() + 40, area.y, 56, area.height}, bands, style.z_name);
  if (!style.title.empty())
    page.text({0.5 * Page::width, page.height() - 76.0}, style.title, {58, {0.5}});
  return page;
}

}  // namespace antilock::figures
