// Curves on logarithmic scales, as in Figure 9; y on a straight one where that is asked for.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "antilock/core/error.hpp"
#include "drawing/legend.hpp"
#include "pictures/chart_marks.hpp"
#include "pictures/pictures.hpp"
#include "pictures/selection.hpp"

namespace antilock::figures {
namespace {

struct Sample {
  double x, y;
};

bool drawable(const Sample& s) {
  return s.x > 0 && s.y > 0 && std::isfinite(s.x) && std::isfinite(s.y);
}

/// A run that gave no answer, but has a place on the x axis.
bool failed(const Sample& s) { return !drawable(s) && s.x > 0 && std::isfinite(s.x); }

/// Panels and curves by meaning, and the points of a curve in the order in which the table brings
/// them.
struct Curves {
  Meanings panels, series;
  std::vector<std::string> failing;  ///< names of the series that have failures
  std::map<std::pair<std::string, std::string>, std::vector<Sample>> samples;

  const std::vector<Sample>& of(std::size_t panel, std::size_t curve) const {
    static const std::vector<Sample> none;
    const auto found = samples.find({panels[panel].name, series[curve].name});
    return found == samples.end() ? none : found->second;
  }
};

/// What a row's curve means: its element alone is not a method where the panel says the mesh.
Meaning series_meaning(const CsvTable& table, std::size_t row, const ChartStyle& style) {
  const Meaning plain = row_meaning(table, row, style.series_by);
  std::vector<std::string> columns = style.series_by;
  columns.insert(columns.end(), style.panel_by.begin(), style.panel_by.end());
  const Meaning method = row_meaning(table, row, columns);
  return method.rank.size() < columns.size() ? method
                                             : plain;  // one row of the table of styles, not two
}

Curves read_curves(const CsvTable& table, const ChartStyle& style) {
  Curves curves;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!selected(table, row, style.filters)) continue;
    const Meaning panel = row_meaning(table, row, style.panel_by),
                  series = series_meaning(table, row, style);
    curves.panels.add(panel);
    curves.series.add(series);
    const Sample sample{table.number(row, style.x), table.number(row, style.y)};
    if (failed(sample) && std::find(curves.failing.begin(), curves.failing.end(), series.name) ==
                              curves.failing.end())
      curves.failing.push_back(series.name);
    curves.samples[{panel.name, series.name}].push_back(sample);
  }
  return curves;
}

/// Series in the order of painting: the widest first, so that narrower ones show on it.
std::vector<std::size_t> painting_order(const Meanings& series) {
  std::vector<std::size_t> order(series.size());
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return series[a].look.width > series[b].look.width;
  });
  return order;
}

/// Markers where they are apart; a dense curve carries some of them.
void draw_markers(Page& page, const std::vector<Point>& points, const Look& look) {
  const Point* last = nullptr;
  for (const Point& point : points) {
    if (last != nullptr && length(point - *last) < 1.6 * look.marker_size()) continue;
    page.marker(point, look.marker, look.marker_size(), look.colour);
    last = &point;
  }
}

/// Places along the curves of a panel, close to each other.
std::vector<Point> taken_places(const Panel& panel, const Curves& curves, std::size_t i) {
  std::vector<Point> taken;
  for (std::size_t n = 0; n < curves.series.size(); ++n) {
    const Point* last = nullptr;
    std::vector<Point> points;
    for (const Sample& s : curves.of(i, n))
      if (drawable(s)) points.push_back(panel(s.x, s.y));
    for (const Point& point : points) {
      for (double t = 0; last != nullptr && t < 1; t += 0.05)
        taken.push_back(*last + t * (point - *last));
      taken.push_back(point);
      last = &point;
    }
  }
  return taken;
}

void draw_curves(Page& page, const Panel& panel, const Curves& curves, std::size_t i) {
  auto order = painting_order(curves.series);
  // single points lie above all curves
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t n) { return curves.of(i, n).size() > 1; });
  for (const std::size_t n : order) {
    const Look& look = curves.series[n].look;
    std::vector<Point> points;
    for (const Sample& s : curves.of(i, n))
      if (drawable(s)) points.push_back(panel(s.x, s.y));
    page.line(points, {look.width, look.colour});
    draw_markers(page, points, look);
  }
  std::vector<Failures> failures;
  for (std::size_t n = 0; n < curves.series.size(); ++n) {
    Failures runs{curves.series[n].look.colour, {}};
    bool before = false;
    std::vector<Sample> samples = curves.of(i, n);
    std::stable_sort(samples.begin(), samples.end(),
                     [](const Sample& a, const Sample& b) { return a.x < b.x; });
    for (const Sample& s : samples) {
      if (failed(s) && before) runs.ranges.back().second = s.x;
      if (failed(s) && !before) runs.ranges.push_back({s.x, s.x});
      before = failed(s);
    }
    if (!runs.ranges.empty()) failures.push_back(std::move(runs));
  }
  draw_strip(page, panel, failures, curves.failing.size());
}

Axis x_axis(const ChartStyle& style, double low, double high, double width) {
  return style.x == "h" ? Axis::halving(low, high, 0.07, static_cast<int>(width / 130))
                        : Axis::logarithmic(low, high, 0.07, static_cast<int>(width / 150));
}

/// `room`: the share of the panel above the curves, for the failures.
Axis y_axis(const ChartStyle& style, double low, double high, double room, double height) {
  const int most = static_cast<int>(height / 90);
  if (!style.linear_y)
    return Axis::logarithmic(low, high * std::pow(high / low, 1.1 * room / (1 - room)), 0.07, most);
  const double more = 0.07 * (high > low ? high - low : high);
  return Axis::linear(low - more, high + more + (high - low) * room / (1 - room), most);
}

}  // namespace

Page chart_picture(const std::filesystem::path& file, const ChartStyle& style) {
  const CsvTable table(file);
  const Curves curves = read_curves(table, style);
  for (std::size_t n = 0; n < curves.series.size(); ++n) tell_unknown(curves.series[n]);
  Sample low{HUGE_VAL, HUGE_VAL}, high{0, 0};
  for (const auto& [names, samples] : curves.samples)
    for (const Sample& s : samples) {
      if (drawable(s) || failed(s)) low.x = std::min(low.x, s.x), high.x = std::max(high.x, s.x);
      if (drawable(s)) low.y = std::min(low.y, s.y), high.y = std::max(high.y, s.y);
    }
  if (style.linear_y && !style.slopes.empty())
    throw Error(
        "a chart with --linear-y has no lines of a slope; accepted: one of --slope and --linear-y");
  if (high.y == 0)
    throw Error(
        fmt::format("{}: no row to draw: {} and {} are finite and above 0 in none; accepted: one "
                    "such row or more",
                    file.string(), style.x, style.y));

  const std::size_t count = curves.panels.size(), columns = panel_columns(count),
                    rows = panel_rows(count);
  const Page measure(1);
  const bool beside = count == 3;  // three panels leave the fourth place of a square to the legend
  std::vector<std::string> entries = curves.series.names([&](const auto& names) {
    const Legend tried(measure, names);
    return beside ? tried.column_width() <= 0.4 * Page::width : tried.lines() <= 2;
  });
  if (!curves.failing.empty()) entries.push_back("no answer");
  const Legend legend(measure, entries);
  const bool below = entries.size() > 1 && !beside;
  const double panel_height = rows > 1      ? 580
                              : columns > 1 ? 760
                                            : 880,
               gap_x = 60, gap_y = head_margin + 30;
  const double head = (style.panel_by.empty() ? 40 : head_margin) + (style.title.empty() ? 0 : 90),
               foot = foot_margin + (below ? legend.height() + 30 : 10);
  const double rows_height =
      static_cast<double>(rows) * panel_height + static_cast<double>(rows - 1) * gap_y;
  Page page(rows_height + head + foot);

  const Axis y = y_axis(style, low.y, high.y, strip_height(curves.failing.size()) / panel_height,
                        panel_height);
  const double left = left_margin(page, y);
  const Box area{left, foot, Page::width - left - 50, rows_height};
  const auto boxes = arrange_panels(count, area, gap_x, gap_y);
  const Axis x = x_axis(style, low.x, high.x, boxes[0].width);
  const auto titles = curves.panels.names([&](const auto& names) {
    return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
      return page.text_width(name, name_size) <= boxes[0].width;
    });
  });
  for (std::size_t i = 0; i < count; ++i) {
    const Panel panel{boxes[i], x, y};
    draw_grid(page, panel);
    draw_curves(page, panel, curves, i);
    draw_slopes(page, panel, style.slopes, taken_places(panel, curves, i));
    draw_frame(page, panel,
               {titles[i], i + columns >= count ? style.x_name : "",
                i % columns == 0 ? style.y_name : ""});
  }
  const auto swatch = [&](std::size_t n, const Box& box) {
    if (n == curves.series.size()) return draw_failure(page, box);
    const Look& look = curves.series[n].look;
    page.line({{box.x, box.centre().y}, {box.right(), box.centre().y}}, {look.width, look.colour});
    page.marker(box.centre(), look.marker, look.marker_size(), look.colour);
  };
  if (below) legend.draw(page, 24, swatch);
  if (beside)
    legend.draw_in(page, {boxes[1].x, boxes[2].y, boxes[1].width, boxes[2].height - foot_margin},
                   swatch);
  if (!style.title.empty())
    page.text({0.5 * Page::width, page.height() - 76.0}, style.title, {58, {0.5}});
  return page;
}

}  // namespace antilock::figures
