// Stacked bars: how a total divides into its parts, such as the seconds of a run into its stages.
#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "antilock/core/error.hpp"
#include "drawing/legend.hpp"
#include "drawing/panel.hpp"
#include "pictures/pictures.hpp"
#include "pictures/selection.hpp"

namespace antilock::figures {
namespace {

struct Bar {
  std::string name;
  std::vector<double> parts;
  double total() const { return std::accumulate(parts.begin(), parts.end(), 0.0); }
};

std::vector<Bar> read_bars(const CsvTable& table, const BarStyle& style, const std::string& file) {
  std::vector<Bar> bars;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!selected(table, row, style.filters)) continue;
    Bar bar{style.x_name.empty() ? row_meaning(table, row, style.bar_by).name
                                 : table.text(row, style.bar_by.front()),
            {}};
    for (const std::string& part : style.parts) {
      const double value = table.number(row, part);
      if (!(value >= 0) || !std::isfinite(value))
        throw Error(fmt::format("{}, row {}: {} = {}; accepted: finite values not below 0", file,
                                row + 1, part, value));
      bar.parts.push_back(value);
    }
    if (bar.total() > 0) bars.push_back(std::move(bar));
  }
  if (bars.empty())
    throw Error(fmt::format(
        "{}: no row to draw: the sum of {} is above 0 in none; accepted: one such row or more",
        file, fmt::join(style.parts, " + ")));
  return bars;
}

/// Colours from dark to light, so that neighbours in a stack differ also in grey.
Colour part_colour(std::size_t n, std::size_t count) {
  return viridis((n + 0.5) / static_cast<double>(count));
}

}  // namespace

Page bar_picture(const std::filesystem::path& file, const BarStyle& style) {
  const CsvTable table(file);
  const auto bars = read_bars(table, style, file.string());
  const std::vector<std::string>& names = style.parts;
  constexpr double size = number_size;
  const Legend legend(Page(1), names);
  const double foot = foot_margin + legend.height() + 30,
               head = 90 + (style.title.empty() ? 0 : 90);
  Page page(800 + foot + head);
  const Box box{230, foot, Page::width - 280.0, 800};
  const Axis percent = Axis::linear(0, 100);
  const double slot = box.width / static_cast<double>(bars.size());

  for (const Tick& tick : percent.ticks()) {
    const double y = box.y + box.height * percent.place(tick.value);
    page.line({{box.x, y}, {box.right(), y}}, {2, palette::pale});
    page.text({box.x - 16, y}, tick.label, {size, {1, Anchor::Height::middle}});
  }
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const double left = box.x + (static_cast<double>(i) + 0.14) * slot, total = bars[i].total();
    double bottom = box.y;
    for (std::size_t n = 0; n < names.size(); ++n) {
      const double height = box.height * bars[i].parts[n] / total;
      page.fill(Box{left, bottom, 0.72 * slot, height}, part_colour(n, names.size()));
      bottom += height;
    }
    const double middle = box.x + (static_cast<double>(i) + 0.5) * slot;
    page.text({middle, box.y - 18}, bars[i].name, {size, {0.5, Anchor::Height::top}});
    page.text({middle, box.top() + 16}, fmt::format("{:.3g}{}", total, style.unit), {size, {0.5}});
  }
  page.rectangle(box, {3});
  page.text({box.x - 130, box.centre().y}, "share (%)", {name_size, {0.5}, 90});
  page.text({box.centre().x, box.y - 84}, style.x_name, {name_size, {0.5, Anchor::Height::top}});
  legend.draw(page, 24, [&](std::size_t n, const Box& swatch) {
    page.fill(swatch, part_colour(n, names.size()));
    page.rectangle(swatch, {2});
  });
  if (!style.title.empty())
    page.text({0.5 * Page::width, page.height() - 76.0}, style.title, {58, {0.5}});
  return page;
}

}  // namespace antilock::figures
