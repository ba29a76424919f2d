// Curves on logarithmic scales, as in Figure 9.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "antilock/scene/error.hpp"
#include "drawing/legend.hpp"
#include "drawing/panel.hpp"
#include "pictures/pictures.hpp"
#include "pictures/selection.hpp"

namespace antilock::figures {
namespace {

struct Sample {
  double x, y;
  double least = x, most = x;  ///< of repeated measurements of x
};

bool drawable(const Sample& s) { return s.x > 0 && s.y > 0 && std::isfinite(s.x) && std::isfinite(s.y); }

/// A run that gave no answer, but has a place on the x axis.
bool failed(const Sample& s) { return !drawable(s) && s.x > 0 && std::isfinite(s.x); }

/// Panels and series by name, and the points of a curve, in the order in which the table brings them.
struct Curves {
  std::vector<std::string> panels, series;
  std::vector<std::string> failing;  ///< the series that have failures
  std::vector<std::size_t> colour;   ///< of each series, where the style says what colours mean
  std::map<std::pair<std::string, std::string>, std::vector<Sample>> samples;
};

Curves read_curves(const Table& table, const ChartStyle& style) {
  Curves curves;
  std::vector<std::string> colours;
  const auto remember = [](std::vector<std::string>& names, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!selected(table, row, style.filters)) continue;
    const std::string panel = key_markup(table, row, style.panel_by), series = key_markup(table, row, style.series_by);
    remember(curves.panels, panel);
    remember(curves.series, series);
    if (!style.colour_by.empty() && curves.colour.size() < curves.series.size()) {
      remember(colours, table.text(row, style.colour_by));
      const auto found = std::find(colours.begin(), colours.end(), table.text(row, style.colour_by));
      curves.colour.push_back(static_cast<std::size_t>(found - colours.begin()));
    }
    Sample sample{table.number(row, style.x), table.number(row, style.y)};
    if (!style.x_least.empty()) sample.least = table.number(row, style.x_least);
    if (!style.x_most.empty()) sample.most = table.number(row, style.x_most);
    if (failed(sample)) remember(curves.failing, series);
    curves.samples[{panel, series}].push_back(sample);
  }
  return curves;
}

/// How the n-th series is drawn; earlier ones are larger, so that curves on top of each other all show.
struct Look {
  Colour colour;
  Marker marker;
  double size, width;
};

Look look(std::size_t n, const Curves& curves) {
  constexpr Marker shapes[] = {Marker::circle,   Marker::square, Marker::diamond,
                               Marker::triangle, Marker::cross,  Marker::down_triangle};
  const std::size_t count = curves.series.size();
  const double shrink = count > 1 ? static_cast<double>(n) / (count - 1) : 0;
  std::size_t colour = n, shape = n + n / 6;
  if (!curves.colour.empty()) {  // series of one colour differ in their markers
    colour = curves.colour[n];
    shape = std::count(curves.colour.begin(), curves.colour.begin() + static_cast<std::ptrdiff_t>(n), colour);
  }
  return {series_colour(colour), shapes[shape % 6], 44 - 26 * shrink, 8 - 4.5 * shrink};
}

/// A mark that no curve has: a ring with a cross in it.
void draw_failure(Page& page, const Point& at, const Colour& colour) {
  page.marker(at, Marker::circle, 44, colour);
  page.marker(at, Marker::circle, 35, palette::white);
  page.marker(at, Marker::cross, 24, colour);
}

/// A right triangle whose long side has the slope p, in the lower right corner of a panel; each next one stands lower.
void draw_slopes(Page& page, const Panel& panel, const std::vector<double>& slopes) {
  const double per_x = panel.box.width / std::log(panel.x.high() / panel.x.low());
  const double per_y = panel.box.height / std::log(panel.y.high() / panel.y.low());
  constexpr double base = 120, size = 36;
  double right = panel.box.right() - 62;
  for (const double slope : slopes) {
    const double rise = slope * per_y * base / per_x;
    const Point corner{right, panel.box.y + 62}, left{right - base, corner.y}, top{right, corner.y + rise};
    page.line({left, corner, top, left, corner}, {2.5, palette::ink});
    page.text(corner + Point{-0.5 * base, -12}, "1", {size, {0.5, Anchor::Height::top}});
    page.text(corner + Point{12, 0.5 * rise}, fmt::format("{:g}", slope), {size, {0, Anchor::Height::middle}});
    right -= base + 90;
  }
}

void draw_curves(Page& page, const Panel& panel, const Curves& curves, const std::string& name) {
  for (std::size_t n = 0; n < curves.series.size(); ++n) {
    const auto found = curves.samples.find({name, curves.series[n]});
    if (found == curves.samples.end()) continue;
    const Look style = look(n, curves);
    std::vector<Point> points;
    for (const Sample& s : found->second)
      if (drawable(s)) points.push_back(panel(s.x, s.y));
    page.line(points, {style.width, style.colour});
    for (const Sample& s : found->second)
      if (drawable(s) && s.least < s.most)
        page.line({panel(s.least, s.y), panel(s.most, s.y)}, {0.6 * style.width, style.colour});
    for (const Point& point : points) page.marker(point, style.marker, style.size, style.colour);
    // failures: above the curves, each series in a row of its own
    const auto row = std::find(curves.failing.begin(), curves.failing.end(), curves.series[n]) - curves.failing.begin();
    for (const Sample& s : found->second)
      if (failed(s))
        draw_failure(page, {panel(s.x, panel.y.high()).x, panel.box.top() - 34 - 38.0 * static_cast<double>(row)},
                     style.colour);
  }
}

}  // namespace

Page chart_picture(const std::filesystem::path& file, const ChartStyle& style) {
  const Table table(file);
  const Curves curves = read_curves(table, style);
  Sample low{HUGE_VAL, HUGE_VAL}, high{0, 0};
  for (const auto& [name, samples] : curves.samples)
    for (const Sample& s : samples) {
      if (drawable(s) || failed(s)) low.x = std::min(low.x, s.least), high.x = std::max(high.x, s.most);
      if (drawable(s)) low.y = std::min(low.y, s.y), high.y = std::max(high.y, s.y);
    }
  if (high.y == 0) throw Error(fmt::format("{}: no row to draw: {} against {}", file.string(), style.y, style.x));

  const std::size_t count = curves.panels.size(), columns = panel_columns(count),
                    rows = (count + columns - 1) / columns;
  const double panel_height = rows == 1 ? 1000 : 700, gap_y = 110, head = 100 + (style.title.empty() ? 0 : 90);
  const int width = columns > 2 ? 2600 : columns > 1 ? 2100 : 1800;
  Page page(width, 100);  // measures the legend; the real page follows
  std::vector<std::string> entries = curves.series;
  if (!curves.failing.empty()) entries.push_back("failed");
  const double legend = entries.size() > 1 ? legend_height(page, entries) : 0, foot = legend + 190;
  const int height = static_cast<int>(rows * panel_height + (rows - 1) * gap_y + head + foot);
  page = Page(width, height);

  // room above the curves for the rows of failures
  const double band = std::pow(high.y / low.y, 0.08 * static_cast<double>(curves.failing.size()));
  const Axis x = Axis::logarithmic(low.x, high.x), y = Axis::logarithmic(low.y, high.y * band);
  const double left = left_margin(page, y);
  const Box area{left, foot, width - left - 50, height - foot - head};
  const auto boxes = arrange_panels(count, area, 60, gap_y);
  for (std::size_t i = 0; i < count; ++i) {
    const Panel panel{boxes[i], x, y};
    draw_grid(page, panel);
    draw_curves(page, panel, curves, curves.panels[i]);
    draw_slopes(page, panel, style.slopes);
    draw_frame(page, panel,
               {curves.panels[i], i + columns >= count ? style.x_name : "", i % columns == 0 ? style.y_name : ""});
  }
  if (legend > 0)
    draw_legend(page, entries, 30, [&](std::size_t n, const Box& box) {
      if (n == curves.series.size()) return draw_failure(page, box.centre(), palette::ink);
      const Look sample = look(n, curves);
      page.line({{box.x, box.centre().y}, {box.right(), box.centre().y}}, {sample.width, sample.colour});
      page.marker(box.centre(), sample.marker, sample.size, sample.colour);
    });
  if (!style.title.empty()) page.text({0.5 * width, height - 76.0}, style.title, {58, {0.5}});
  return page;
}

}  // namespace antilock::figures
