#include "drawing/legend.hpp"

#include <numeric>

namespace antilock::figures {
namespace {

constexpr double size = 46, swatch_width = 100, space = 20, gap = 70, line_height = 74;

struct Line {
  std::vector<std::size_t> entries;
  double width = -gap;
};

double entry_width(const Page& page, const std::string& name) {
  return swatch_width + space + page.text_width(name, size) + gap;
}

std::vector<Line> break_lines(const Page& page, const std::vector<std::string>& names) {
  std::vector<Line> lines(1);
  for (std::size_t n = 0; n < names.size(); ++n) {
    const double width = entry_width(page, names[n]);
    if (!lines.back().entries.empty() && lines.back().width + width > page.width() - 200) lines.emplace_back();
    lines.back().entries.push_back(n);
    lines.back().width += width;
  }
  return lines;
}

}  // namespace

double legend_height(const Page& page, const std::vector<std::string>& names) {
  return line_height * static_cast<double>(break_lines(page, names).size());
}

void draw_legend(Page& page, const std::vector<std::string>& names, double bottom, const Swatch& swatch) {
  double y = bottom + legend_height(page, names) - 0.5 * line_height;
  for (const Line& line : break_lines(page, names)) {
    double x = 0.5 * (page.width() - line.width);
    for (const std::size_t n : line.entries) {
      swatch(n, {x, y - 0.3 * line_height, swatch_width, 0.6 * line_height});
      page.text({x + swatch_width + space, y}, names[n], {size, {0, Anchor::Height::middle}});
      x += entry_width(page, names[n]);
    }
    y -= line_height;
  }
}

}  // namespace antilock::figures
