// Columns of a table as curves over one of them, on straight scales, a panel beside the other.
#include <fmt/format.h>

#include <algorithm>

#include "antilock/scene/error.hpp"
#include "drawing/legend.hpp"
#include "drawing/panel.hpp"
#include "pictures/pictures.hpp"
#include "pictures/table.hpp"

namespace antilock::figures {
namespace {

constexpr const char* nothing = "-";  // a place in the legend that a panel leaves empty

/// The n-th curve: the first, if it is the truth, lies behind, broad and pale; the others carry markers at the rows (of
/// more than 128, at about 20 of them).
struct Look {
  Colour colour;
  double width, marker_size;
  Marker marker;
};

Look look(std::size_t n, bool truth_first) {
  constexpr Marker shapes[] = {Marker::circle, Marker::square, Marker::diamond, Marker::triangle};
  if (truth_first && n == 0) return {palette::grey, 12, 0, Marker::circle};
  const std::size_t k = n - (truth_first ? 1 : 0);
  return {series_colour(k), 4.5, 22, shapes[k % 4]};
}

void draw(Page& page, const Look& style, const std::vector<Point>& points) {
  page.line(points, {style.width, style.colour});
  if (style.marker_size > 0)
    for (std::size_t i = 0; i<points.size(); i += points.size()> 128 ? points.size() / 20 : 1)
      page.marker(points[i], style.marker, style.marker_size, style.colour);
}

std::vector<std::string> split_columns(const std::string& list) {
  std::vector<std::string> columns{""};
  for (const char c : list)
    if (c == ' ')
      columns.emplace_back();
    else
      columns.back() += c;
  return columns;
}

/// The straight axis of these columns, with some room above and below.
Axis value_axis(const Table& table, const std::vector<std::string>& columns) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const std::string& column : columns) {
    if (column == nothing) continue;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      low = std::min(low, table.number(row, column));
      high = std::max(high, table.number(row, column));
    }
  }
  const double room = high > low ? 0.06 * (high - low) : 1;
  return Axis::linear(low - room, high + room);
}

}  // namespace

Page curves_picture(const std::filesystem::path& file, const CurvesStyle& style) {
  const Table table(file);
  if (table.rows() < 2) throw Error(fmt::format("{}: a curve needs two rows", file.string()));
  std::vector<Axis> values;
  for (const std::string& list : style.panels) {
    const auto columns = split_columns(list);
    if (columns.size() != style.names.size())
      throw Error(fmt::format("panel {}: {} columns for {} names", list, columns.size(), style.names.size()));
    values.push_back(value_axis(table, columns));
  }
  const Axis x = Axis::linear(table.number(0, style.x), table.number(table.rows() - 1, style.x));

  const std::size_t count = style.panels.size();
  const int width = count > 1 ? 2400 : 1800;
  Page page(width, 100);  // measures the legend; the real page follows
  const double foot = legend_height(page, style.names) + 190, head = 60;
  page = Page(width, static_cast<int>(foot + 850 + head));
  double left = 0;  // every panel has numbers of its own
  for (const Axis& axis : values) left = std::max(left, left_margin(page, axis));
  const auto panel_width = (width - 50.0) / static_cast<double>(count) - left - 20;
  for (std::size_t i = 0; i < count; ++i) {
    const Panel panel{
        {left + static_cast<double>(i) * (panel_width + left + 20), foot, panel_width, 850}, x, values[i]};
    draw_grid(page, panel);
    const auto columns = split_columns(style.panels[i]);
    for (std::size_t n = 0; n < columns.size(); ++n) {
      if (columns[n] == nothing) continue;
      std::vector<Point> points;
      for (std::size_t row = 0; row < table.rows(); ++row)
        points.push_back(panel(table.number(row, style.x), table.number(row, columns[n])));
      draw(page, look(n, style.truth_first), points);
    }
    draw_frame(page, panel, {"", style.x_name, i < style.y_names.size() ? style.y_names[i] : style.panels[i]});
  }
  draw_legend(page, style.names, 30, [&](std::size_t n, const Box& box) {
    const Look sample = look(n, style.truth_first);
    page.line({{box.x, box.centre().y}, {box.right(), box.centre().y}}, {sample.width, sample.colour});
    if (sample.marker_size > 0) page.marker(box.centre(), sample.marker, sample.marker_size, sample.colour);
  });
  return page;
}

}  // namespace antilock::figures
