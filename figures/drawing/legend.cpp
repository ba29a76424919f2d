#include "drawing/legend.hpp"

#include <algorithm>

namespace antilock::figures {
namespace {

constexpr double size = 48, swatch_width = 100, space = 20, gap = 64, line_height = 76, edge = 60;

}  // namespace

Legend::Legend(const Page& page, const std::vector<std::string>& names) : names_(names) {
  for (const std::string& name : names)
    widths_.push_back(swatch_width + space + page.text_width(name, size));
  break_lines(names.size());
  if (!lines_.empty())
    break_lines((names.size() + lines_.size() - 1) / lines_.size());  // about as many in each
}

void Legend::break_lines(std::size_t most) {
  lines_.clear();
  for (std::size_t n = 0; n < names_.size(); ++n) {
    const bool full =
        !lines_.empty() && (lines_.back().entries.size() == most ||
                            lines_.back().width + gap + widths_[n] > Page::width - 2 * edge);
    if (lines_.empty() || full) lines_.push_back({{}, -gap});
    lines_.back().entries.push_back(n);
    lines_.back().width += gap + widths_[n];
  }
}

double Legend::height() const { return line_height * static_cast<double>(lines_.size()); }

void Legend::draw(Page& page, double bottom, const Swatch& swatch) const {
  double y = bottom + height() - 0.5 * line_height;
  for (const Line& line : lines_) {
    double x = 0.5 * (Page::width - line.width);
    for (const std::size_t n : line.entries) {
      swatch(n, {x, y - 0.3 * line_height, swatch_width, 0.6 * line_height});
      page.text({x + swatch_width + space, y}, names_[n], {size, {0, Anchor::Height::middle}});
      x += widths_[n] + gap;
    }
    y -= line_height;
  }
}

double Legend::column_width() const {
  return widths_.empty() ? 0 : *std::max_element(widths_.begin(), widths_.end());
}

void Legend::draw_in(Page& page, const Box& box, const Swatch& swatch) const {
  const double x = box.centre().x - 0.5 * column_width();
  double y = box.centre().y + 0.5 * line_height * static_cast<double>(names_.size() - 1);
  for (std::size_t n = 0; n < names_.size(); ++n, y -= line_height) {
    swatch(n, {x, y - 0.3 * line_height, swatch_width, 0.6 * line_height});
    page.text({x + swatch_width + space, y}, names_[n], {size, {0, Anchor::Height::middle}});
  }
}

}  // namespace antilock::figures
