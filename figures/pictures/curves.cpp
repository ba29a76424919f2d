// Columns of a table as curves over one of them, on straight scales, one panel beside the other.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "antilock/core/error.hpp"
#include "drawing/legend.hpp"
#include "drawing/panel.hpp"
#include "drawing/styles.hpp"
#include "pictures/pictures.hpp"
#include "pictures/table.hpp"

namespace antilock::figures {
namespace {

constexpr const char* nothing = "-";  // a curve that a panel does not have
constexpr std::size_t dense = 50;     // curves of more rows carry no markers

std::vector<std::string> split_columns(const std::string& list) {
  std::vector<std::string> columns{""};
  for (const char c : list)
    if (c == ' ')
      columns.emplace_back();
    else
      columns.back() += c;
  return columns;
}

/// The straight axis of these columns, with some room above and below; stems stand on 0.
Axis value_axis(const CsvTable& table, const std::vector<std::string>& columns) {
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

/// The pieces of a curve between its jumps: steps that are unlike both of their neighbours, by
/// three quarters of these and a hundredth of the whole.
std::vector<std::vector<Point>> pieces(const std::vector<Point>& curve) {
  const auto [low, high] = std::minmax_element(
      curve.begin(), curve.end(), [](const Point& a, const Point& b) { return a.y < b.y; });
  const double least = 0.01 * (high->y - low->y);
  const auto step = [&](std::size_t i) { return curve[i + 1].y - curve[i].y; };
  const auto unlike = [&](std::size_t i, std::size_t beside) {
    return std::abs(step(i) - step(beside)) > std::max(0.75 * std::abs(step(beside)), least);
  };
  std::vector<std::vector<Point>> found(1);
  for (std::size_t i = 0; i < curve.size(); ++i) {
    found.back().push_back(curve[i]);
    if (i > 0 && i + 2 < curve.size() && unlike(i, i - 1) && unlike(i, i + 1)) found.emplace_back();
  }
  return found;
}

/// Values at points, on lines from 0; those of several curves stand beside each other.
void draw_stems(Page& page, const Panel& panel, const std::vector<Point>& points, const Look& look,
                double aside) {
  const double zero = panel(panel.x.low(), 0).y;
  for (const Point& point : points) {
    const Point top = point + Point{aside, 0};
    if (std::abs(top.y - zero) < 1) continue;  // no force
    page.line({{top.x, zero}, top}, {0.8 * look.width, look.colour});
    page.marker(top, look.marker, 0.8 * look.marker_size(), look.colour);
  }
}

void draw_curve(Page& page, const std::vector<Point>& points, const Look& look, bool exact,
                bool jumps) {
  for (const auto& piece : jumps ? pieces(points) : std::vector<std::vector<Point>>{points})
    page.line(piece, {look.width, look.colour});
  if (exact || points.size() > dense) return;
  for (const Point& point : points)
    page.marker(point, look.marker, 0.75 * look.marker_size(), look.colour);
}

}  // namespace

Page curves_picture(const std::filesystem::path& file, const CurvesStyle& style) {
  const CsvTable table(file);
  if (table.rows() < 2) throw Error(fmt::format("{}: a curve needs two rows", file.string()));
  std::vector<Axis> values;
  for (const std::string& list : style.panels) {
    const auto columns = split_columns(list);
    if (columns.size() != style.meanings.size())
      throw Error(fmt::format("panel {}: {} columns for {} meanings", list, columns.size(),
                              style.meanings.size()));
    values.push_back(value_axis(table, columns));
  }
  std::vector<Look> looks;
  std::vector<std::string> names;
  for (const std::string& key : style.meanings) {
    const Meaning meaning = meaning_of(key);
    tell_unknown(meaning);
    looks.push_back(meaning.known ? meaning.look : other_look(looks.size()));
    names.push_back(meaning.name);
  }
  const bool marked = table.rows() <= dense;
  const double first = table.number(0, style.x), last = table.number(table.rows() - 1, style.x),
               room =
                   marked ? 0.03 * (last - first) : 0;  // a marker stands on no frame and no number
  const Axis x = Axis::linear(first - room, last + room);

  const std::size_t count = style.panels.size();
  const Legend legend(Page(1), names);
  const bool several = names.size() > 1;
  const double foot = foot_margin + (several ? legend.height() + 30 : 10),
               height = count > 1 ? 760 : 880;
  Page page(foot + height + 50);
  double left = 0;  // every panel has numbers of its own
  for (const Axis& axis : values) left = std::max(left, left_margin(page, axis));
  const double panel_width = (Page::width - 40.0) / static_cast<double>(count) - left - 20;
  for (std::size_t i = 0; i < count; ++i) {
    const Panel panel{
        {left + static_cast<double>(i) * (panel_width + left + 20), foot, panel_width, height},
        x,
        values[i]};
    draw_grid(page, panel);
    const bool stems = std::find(style.stems.begin(), style.stems.end(), static_cast<int>(i) + 1) !=
                       style.stems.end();
    const auto columns = split_columns(style.panels[i]);
    for (std::size_t n = 0; n < columns.size(); ++n) {
      if (columns[n] == nothing) continue;
      std::vector<Point> points;
      for (std::size_t row = 0; row < table.rows(); ++row)
        points.push_back(panel(table.number(row, style.x), table.number(row, columns[n])));
      if (stems)
        draw_stems(page, panel, points, looks[n], 7.0 * (n % 2 == 0 ? 1 : -1));
      else
        draw_curve(page, points, looks[n], style.meanings[n] == "exact", style.jumps);
    }
    draw_frame(page, panel,
               {"", style.x_name, i < style.y_names.size() ? style.y_names[i] : style.panels[i]});
  }
  if (several)
    legend.draw(page, 24, [&](std::size_t n, const Box& box) {
      const Look& look = looks[n];
      page.line({{box.x, box.centre().y}, {box.right(), box.centre().y}},
                {look.width, look.colour});
      if (style.meanings[n] != "exact" && marked)
        page.marker(box.centre(), look.marker, 0.75 * look.marker_size(), look.colour);
    });
  return page;
}

}  // namespace antilock::figures
